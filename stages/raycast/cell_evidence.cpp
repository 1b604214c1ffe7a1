// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/cell_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace roomcut::raycast {
namespace {

constexpr float kPermanent = 0.5F;  // paper: a face with omega above 1/2 is permanent
constexpr int kColumns = 8;         // looking up and down
constexpr double kNoLimit = std::numeric_limits<double>::infinity();
constexpr double kRising = 0.2;  // sine of the elevation from which a ray looks at the sky or the ground
constexpr double kPlate = 0.3;   // [m] a cell up to this thickness counts as a wall or slab …
constexpr double kWide = 0.6;    // [m] … from this on not at all
constexpr double kStorey = 1.0;  // [m] layers as high hold no slab
constexpr double kInside = 0.3;  // share of a thin upright cell that may be looked through in a wall …
constexpr double kRim = 0.8;     // … and from which on it is a room's rim
constexpr LineLengths kWalls{0.4, 0.8, 8};    // [m] across walls and rooms
constexpr LineLengths kStoreys{1.8, 2.3, 5};  // [m] nobody stands below 1.8 m
constexpr double kOpaque = 1e-3;              // a ray of which less is left has ended

struct RayStart {
  Vec3 origin, direction;
};

/// Numbers in [0, 1) that spread the rays of a cell evenly over its places and directions: the additive
/// recurrence with powers of the generalised golden ratio (Roberts' R5), begun where the cell's middle says.
/// Neither the cell's number nor anything else but its place has a say, and that smoothly: the same cell in a
/// complex with another line somewhere, or moved by a rounding, is asked by the same rays.
class RaySequence {
 public:
  static constexpr std::size_t kNumbers = 5;

  explicit RaySequence(const Vec3& middle) {
    constexpr double kRatio = 1.1347241384015194;  // x^6 = x + 1
    constexpr double kPerMetre = 7;                // cells side by side begin apart
    double power = 1;
    for (std::size_t k = 0; k < kNumbers; ++k) {
      power /= kRatio;
      step_[k] = power;
      const double turn = static_cast<double>(k + 1) * power;
      begin_[k] =
          kPerMetre * (std::cos(turn) * middle.x() + std::sin(turn) * middle.y() + power * middle.z());
    }
  }
  double number(std::size_t i, std::size_t k) const {
    const double sum = begin_[k] + static_cast<double>(i + 1) * step_[k];
    return sum - std::floor(sum);
  }

 private:
  std::array<double, kNumbers> step_{}, begin_{};
};

RayStart ray_from(const CellComplex& complex, const FaceWalk& walk, std::size_t face, std::size_t layer,
                  const RaySequence& sequence, const RayRules& rules, std::size_t ray) {
  // Every other ray is level: it still counts walls where floor or ceiling was not seen. Two of them are one
  // line, followed both ways.
  const bool level = rules.level && ray % 2 == 0;
  const bool back = level && ray % 4 == 2;
  const auto number = [&](std::size_t k) {
    return sequence.number(level ? ray / 4 : rules.level ? ray / 2 : ray, k);
  };
  const double azimuth = std::numbers::pi * (level ? number(3) + (back ? 1 : 0) : 2 * number(3));
  const double up = level ? 0.0 : 2 * number(4) - 1;
  const double flat = std::sqrt(1 - up * up);
  const Vec3 direction{flat * std::cos(azimuth), flat * std::sin(azimuth), up};
  if (rules.from_centre) return {complex.centre(complex.cell(face, layer)), direction};
  const Vec2 p = walk.point_in(face, number(0), number(1));
  return {{p.x(), p.y(), complex.levels[layer] + number(2) * complex.height(layer)}, direction};
}

/// Covered area of the cell's own faces that shows it its front (.first) or its back (.second).
void add_own_faces(const CellComplex& complex, const FaceWeights& weights, std::size_t face,
                   std::size_t layer, CellEvidence& evidence) {
  for (const std::int32_t side : complex.edges_of(face)) {
    const auto edge = static_cast<std::size_t>(side);
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

double CellEvidence::thin() const {
  // Of a plate this is its thickness; of a room about half its width.
  const double thickness = total_m2 > 0 ? 2 * volume_m3 / total_m2 : 0;
  return std::clamp((kWide - thickness) / (kWide - kPlate), 0.0, 1.0);
}

bool CellEvidence::surely_indoors() const {
  // Of a furnished room's walls, or of a glazed one's, less is seen than of its floor and ceiling.
  constexpr double kEnough = 0.6;  // level and upright lines together, of 2
  constexpr double kFree = 0.15;   // of the rays: not inside a wall
  return across.fronts + upright.fronts >= kEnough && around.near_back < kFree;
}

double CellEvidence::looked_through() const {
  // Through windows a scanner sees air that is no room's. Through doors, stairs and gaps of furniture it sees
  // a part of the inside of walls and slabs; of a room's rim behind furniture it sees more.
  const double wall = height_m >= kStorey ? thin() : 0;
  const double rim = std::clamp((carved - kInside) / (kRim - kInside), 0.0, 1.0);
  return (1 - upright.both_open) * (1 - sky) * ((1 - thin()) * carved + wall * rim);
}

double CellEvidence::in_slab() const {
  return 0.5 * (up.near_back + down.near_back);
}

namespace {

void count_crossings(const std::vector<Crossing>& crossings, CellEvidence& evidence) {
  bool odd = false;
  for (const Crossing& c : crossings) {
    odd = odd != (c.omega > kPermanent);
    evidence.winding += c.front - c.back;
  }
  evidence.kappa += odd ? 1 : 0;
}

/// Crossings are counted to the end of a ray. A flat one only ends beyond the building, perhaps hundreds of
/// metres away: unless parity is what counts, it is followed as far as anything of it is left.
void look_around(const CellComplex& complex, const FaceWalk& walk, std::size_t face, std::size_t layer,
                 const RayRules& rules, std::vector<Crossing>& scratch, CellEvidence& evidence) {
  const int rays = rules.rays;
  const RaySequence sequence(complex.centre(complex.cell(face, layer)));
  int rising = 0;
  int level = 0;
  int counted = 0;
  FirstHit before;
  for (int r = 0; r < rays; ++r) {
    const RayStart start = ray_from(complex, walk, face, layer, sequence, rules, static_cast<std::size_t>(r));
    // Without level rays those that hardly rise or fall tell how open a cell is.
    const bool is_level = std::abs(start.direction.z()) <= (rules.level ? 0 : kRising);
    const bool to_the_end = rules.parity || std::abs(start.direction.z()) > kRising;
    walk.follow({start.origin, start.direction, face, layer}, scratch, kNoLimit, to_the_end ? 0 : kOpaque);
    if (to_the_end) {
      ++counted;
      count_crossings(scratch, evidence);
    }
    const FirstHit hit = first_hit(scratch);
    evidence.around.add(hit, 1.0 / rays);
    if (is_level) {
      ++level;
      evidence.level.add(hit, 1);
      if (level % 2 == 0) evidence.across.add(before, hit, kWalls, 1);
      before = hit;
    }
    if (start.direction.z() > kRising) {
      ++rising;
      evidence.sky += hit.nothing();
    }
  }
  if (level == 0) evidence.level.front = 1;  // none was asked: no sign of an opening
  evidence.across = evidence.across.mean(level / 2);
  FirstHit mean;
  mean.add(evidence.level, 1.0 / std::max(1, level));
  evidence.level = mean;
  evidence.kappa /= std::max(1, counted);
  evidence.sky /= std::max(1, rising);
  evidence.winding /= std::max(1, counted);
}

void look_up_and_down(const CellComplex& complex, const FaceWalk& walk, std::size_t face, std::size_t layer,
                      std::vector<Crossing>& scratch, CellEvidence& evidence) {
  const double z = 0.5 * (complex.levels[layer] + complex.levels[layer + 1]);
  for (int i = 0; i < kColumns; ++i) {
    // Spread evenly over the face (golden ratio).
    const Vec2 p = walk.point_in(face, (i + 0.5) / kColumns, std::fmod(0.5 + i * std::numbers::phi, 1.0));
    const auto look = [&](double up) {
      walk.follow({{p.x(), p.y(), z}, {0, 0, up}, face, layer}, scratch, kNoLimit, kOpaque);
      return first_hit(scratch);
    };
    const FirstHit down = look(-1);
    const FirstHit up = look(1);
    evidence.down.add(down, 1.0 / kColumns);
    evidence.up.add(up, 1.0 / kColumns);
    evidence.upright.add(down, up, kStoreys, 1.0 / kColumns);
  }
}

}  // namespace

CellEvidence gather_evidence(const CellComplex& complex, const FaceWeights& weights, const FaceWalk& walk,
                             std::size_t face, std::size_t layer, const RayRules& rules,
                             std::vector<Crossing>& scratch) {
  CellEvidence evidence;
  evidence.height_m = complex.height(layer);
  evidence.volume_m3 = complex.area(face) * evidence.height_m;
  add_own_faces(complex, weights, face, layer, evidence);
  look_around(complex, walk, face, layer, rules, scratch, evidence);
  look_up_and_down(complex, walk, face, layer, scratch, evidence);
  return evidence;
}

}  // namespace roomcut::raycast
