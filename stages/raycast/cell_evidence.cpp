// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/cell_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/random/counter_random.h"

namespace roomcut {
namespace {

constexpr std::uint64_t kSeed = 2013;
constexpr float kPermanent = 0.5F;  // paper: a face with omega above 1/2 is permanent
constexpr double kColumnLimit =
    8.0;  // [m] looking up and down: no room is higher, and far levels are another storey's
constexpr double kNoLimit = std::numeric_limits<double>::infinity();
constexpr double kThickness = 0.5;  // [m] of walls and slabs: how far behind a surface solid is likely
constexpr double kRising = 0.2;     // sine of the elevation from which a ray looks at the sky
constexpr double kOpaque = 1e-3;    // a ray of which less is left has ended

struct RayStart {
  Vec3 origin, direction;
};

RayStart random_ray(const CellComplex& complex, const FaceWalk& walk, std::size_t face, std::size_t layer,
                    std::size_t ray) {
  const std::uint64_t stream = complex.cell(face, layer);
  const auto number = [&](std::uint64_t k) { return random_unit(kSeed, stream, ray * 5 + k); };
  const Vec2 p = walk.point_in(face, number(0), number(1));
  const double z = complex.levels[layer] + number(2) * complex.height(layer);
  const double azimuth = 2 * std::numbers::pi * number(3);
  // Every other ray is level: it still counts walls where floor or ceiling was not seen.
  const double up = ray % 2 == 0 ? 0.0 : 2 * number(4) - 1;
  const double flat = std::sqrt(1 - up * up);
  return {{p.x(), p.y(), z}, {flat * std::cos(azimuth), flat * std::sin(azimuth), up}};
}

/// Covered area of the cell's own faces that shows it its front (.first) or its back (.second).
void add_own_faces(const CellComplex& complex, const FaceWeights& weights, std::size_t face,
                   std::size_t layer, CellEvidence& evidence) {
  for (auto i = static_cast<std::size_t>(complex.face_offset[face]);
       i < static_cast<std::size_t>(complex.face_offset[face + 1]); ++i) {
    const auto edge = static_cast<std::size_t>(complex.face_edge[i]);
    const bool is_left = complex.edges[edge].left == static_cast<std::int32_t>(face);
    const std::size_t w = complex.wall_face(edge, layer);
    const double area = complex.length(edge) * complex.height(layer);
    evidence.total_m2 += area;
    evidence.front_m2 += area * (is_left ? weights.wall_left[w] : weights.wall_right[w]);
    evidence.back_m2 += area * (is_left ? weights.wall_right[w] : weights.wall_left[w]);
  }
  const double area = complex.area(face);
  const std::size_t below = complex.level_face(face, layer);
  const std::size_t above = complex.level_face(face, layer + 1);
  evidence.front_m2 += area * (weights.level_floor[below] + weights.level_ceiling[above]);
  evidence.back_m2 += area * (weights.level_ceiling[below] + weights.level_floor[above]);
  evidence.total_m2 += 2 * area;
}

}  // namespace

FirstHit first_hit(const std::vector<Crossing>& crossings) {
  FirstHit hit;
  double left = 1;
  for (const Crossing& c : crossings) {
    if (left < kOpaque) {
      break;
    }
    hit.front += left * c.front;
    hit.back += left * c.back;
    hit.near_back += left * c.back * std::exp(-c.distance / kThickness);
    left *= 1 - c.front - c.back;
  }
  return hit;
}

CellEvidence gather_evidence(const CellComplex& complex, const FaceWeights& weights, const FaceWalk& walk,
                             std::size_t face, std::size_t layer, int rays, std::vector<Crossing>& scratch) {
  CellEvidence evidence;
  add_own_faces(complex, weights, face, layer, evidence);
  int rising = 0;
  for (int r = 0; r < rays; ++r) {
    const RayStart start = random_ray(complex, walk, face, layer, static_cast<std::size_t>(r));
    walk.follow({start.origin, start.direction, face, layer}, kNoLimit, scratch);
    bool odd = false;
    for (const Crossing& c : scratch) {
      odd = odd != (c.omega > kPermanent);
      evidence.winding += c.front - c.back;
    }
    evidence.kappa += odd ? 1 : 0;
    const FirstHit hit = first_hit(scratch);
    evidence.around.front += hit.front / rays;
    evidence.around.back += hit.back / rays;
    if (start.direction.z() > kRising) {
      ++rising;
      evidence.sky += std::max(0.0, 1 - hit.front - hit.back);
    }
    evidence.around.near_back += hit.near_back / rays;
  }
  evidence.kappa /= rays;
  evidence.sky /= std::max(1, rising);
  evidence.winding /= rays;
  const Vec2 middle = complex.centroid(face);
  const double z = 0.5 * (complex.levels[layer] + complex.levels[layer + 1]);
  for (const double up : {-1.0, 1.0}) {
    walk.follow({{middle.x(), middle.y(), z}, {0, 0, up}, face, layer}, kColumnLimit, scratch);
    const FirstHit hit = first_hit(scratch);
    evidence.vertical.front += 0.5 * hit.front;
    evidence.vertical.back += 0.5 * hit.back;
    evidence.vertical.near_back += 0.5 * hit.near_back;
  }
  return evidence;
}

}  // namespace roomcut
