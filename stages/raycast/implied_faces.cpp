// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/implied_faces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "stages/raycast/cell_evidence.h"

namespace roomcut::raycast {
namespace {

constexpr double kCommon = 0.4;      // [m] thickness of common walls and slabs
constexpr double kThickest = 0.8;    // [m]
constexpr double kSampleStep = 0.5;  // [m] along an edge
constexpr double kTrust = 0.9;       // slivers at the ends of walls should still prefer the smaller surface
constexpr int kMostSamples = 12;

/// Share of the ray that ends on a back close by.
double back_near(const std::vector<Crossing>& crossings) {
  double back = 0;
  double left = 1;
  for (const Crossing& c : crossings) {
    back += left * c.back * thickness_weight(c.distance);
    left *= 1 - c.front - c.back;
  }
  return back;
}

double look(const FaceWalk& walk, const Ray& ray, std::vector<Crossing>& scratch) {
  walk.follow(ray, scratch, kThickest);
  return back_near(scratch);
}

float implied_wall(const CellComplex& complex, const FaceWalk& walk, std::size_t edge, std::size_t layer,
                   std::vector<Crossing>& scratch) {
  const CellComplex::Edge& e = complex.edges[edge];
  // A line that may not carry a wall in the layer is no other side of one either.
  if (e.line < 0 || !complex.lines[static_cast<std::size_t>(e.line)].carries(layer)) {
    return 0;
  }
  const Vec2& a = complex.vertices[static_cast<std::size_t>(e.v0)];
  const Vec2 along = complex.vertices[static_cast<std::size_t>(e.v1)] - a;
  const Vec2 left = Vec2(-along.y(), along.x()).normalized();
  const double z = 0.5 * (complex.levels[layer] + complex.levels[layer + 1]);
  const int samples = std::clamp(static_cast<int>(std::ceil(along.norm() / kSampleStep)), 1, kMostSamples);
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const Vec2 p = a + (i + 0.5) / samples * along;
    double best = 0;
    for (const std::int32_t face : {e.left, e.right}) {
      if (face >= 0) {
        const Vec2 to = face == e.left ? left : Vec2(-left);
        const Ray ray{{p.x(), p.y(), z}, {to.x(), to.y(), 0}, static_cast<std::size_t>(face), layer};
        best = std::max(best, look(walk, ray, scratch));
      }
    }
    sum += best;
  }
  return static_cast<float>(std::clamp(sum / samples, 0.0, 1.0));
}

float implied_level(const CellComplex& complex, const FaceWalk& walk, std::size_t face, std::size_t level,
                    std::vector<Crossing>& scratch) {
  const Vec2 p = complex.centroid(face);
  const double z = complex.levels[level];
  double best = 0;
  if (level < complex.layers()) {
    best = std::max(best, look(walk, {{p.x(), p.y(), z}, {0, 0, 1}, face, level}, scratch));
  }
  if (level > 0) {
    best = std::max(best, look(walk, {{p.x(), p.y(), z}, {0, 0, -1}, face, level - 1}, scratch));
  }
  return static_cast<float>(std::clamp(best, 0.0, 1.0));
}

}  // namespace

double thickness_weight(double distance_m) {
  return kTrust * std::clamp((kThickest - distance_m) / (kThickest - kCommon), 0.0, 1.0);
}

ImpliedFaces find_implied_faces(const CellComplex& complex, const FaceWalk& walk) {
  const std::size_t edges = complex.edges.size();
  const std::size_t faces = complex.faces();
  ImpliedFaces implied;
  implied.wall.assign(edges * complex.layers(), 0);
  implied.level.assign(faces * complex.levels.size(), 0);
  tbb::parallel_for(std::size_t{0}, complex.levels.size(), [&](std::size_t l) {
    std::vector<Crossing> scratch;
    for (std::size_t e = 0; l < complex.layers() && e < edges; ++e) {
      implied.wall[complex.wall_face(e, l)] = implied_wall(complex, walk, e, l, scratch);
    }
    for (std::size_t f = 0; f < faces; ++f) {
      implied.level[complex.level_face(f, l)] = implied_level(complex, walk, f, l, scratch);
    }
  });
  return implied;
}

}  // namespace roomcut::raycast
