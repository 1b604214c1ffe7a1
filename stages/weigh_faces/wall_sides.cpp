// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/wall_sides.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/cells/plan_walk.h"

namespace roomcut::weigh_faces {
namespace {

constexpr double kSeen = 0.15;      // coverage of a floor or ceiling on either side: enough to ask
constexpr double kEnough = 0.75;    // coverage beyond which no further floor or ceiling is asked
constexpr double kPrior = 0.1;      // coverage below which neither side is believed
constexpr double kLevelWeight = 5;  // log-odds of a floor that is whole on one side and missing on the other
constexpr double kStripWeight = 5;  // the same for the strips
constexpr double kNearlyEqual = 0.03;  // [m] lines nearer than this are one wall's face
constexpr double kSliver = 0.1;        // [m] how far off the next face is still the wall's side

}  // namespace

namespace {

/// What floors, or ceilings, say of the two sides of a wall, from the nearest level on: as far as nothing
/// nearer was seen. A door's threshold or head inside the wall is a floor or ceiling too, of a part of it.
class Sides {
 public:
  /// Shares of the wall's sides that a level covers.
  void add(double left, double right) {
    left_ += open_ * left;
    right_ += open_ * right;
    open_ *= std::max(0.0, 1 - std::max(left, right) / kEnough);
  }
  bool closed() const { return open_ <= 0; }
  double left() const { return left_; }
  double right() const { return right_; }

 private:
  double left_ = 0, right_ = 0;
  double open_ = 1;
};

}  // namespace

FacesBeside::FacesBeside(const CellComplex& complex, std::size_t edge, bool left, double beside_m) {
  const auto count = [&](double distance_m) {
    std::size_t crossed = 0;
    walk_beside(complex, edge, left, distance_m, [&](std::size_t, bool) { ++crossed; });
    return crossed;
  };
  const std::size_t equal = count(kNearlyEqual);
  const std::size_t beside = count(beside_m);
  nearest_ = walk_beside(complex, edge, left, kNearlyEqual);
  std::size_t crossed = 0;
  walk_beside(complex, edge, left, std::max(beside_m, kSliver), [&](std::size_t other, bool from_left) {
    const CellComplex::Edge& e = complex.edges[other];
    if (++crossed > equal) {
      beyond_.push_back({other, from_left ? e.right : e.left, crossed <= beside});
    }
  });
}

std::int32_t FacesBeside::face(const CellComplex& complex, const FaceWeights& weights,
                               std::size_t layer) const {
  std::int32_t found = nearest_;
  for (const Step& step : beyond_) {
    const std::int32_t line = complex.edges[step.edge].line;
    const bool open = line >= 0 && !complex.lines[static_cast<std::size_t>(line)].carries(layer);
    const bool within = step.within && !weights.is_wall(complex.wall_face(step.edge, layer));
    if (!open && !within) {
      break;
    }
    found = step.face;
  }
  return found;
}

double left_probability(const CellComplex& complex, const FaceWeights& weights, std::size_t edge,
                        std::size_t layer, const StripShares& strips, const FacesBeside& left,
                        const FacesBeside& right) {
  const std::int32_t left_face = left.face(complex, weights, layer);
  const std::int32_t right_face = right.face(complex, weights, layer);
  const auto goes_on = [&](std::size_t k) { return weights.is_wall(complex.wall_face(edge, k)); };
  double score = kStripWeight * (strips.left - strips.right);
  const auto look = [&](const std::vector<float>& kind, bool up) {
    const auto on = [&](std::int32_t face, std::size_t level) {
      return face < 0 ? 0.0 : kind[complex.level_face(static_cast<std::size_t>(face), level)];
    };
    Sides sides;
    for (std::size_t k = layer;; k = up ? k + 1 : k - 1) {
      const std::size_t level = up ? k + 1 : k;
      sides.add(on(left_face, level), on(right_face, level));
      const bool at_end = up ? level == complex.layers() : level == 0;
      if (sides.closed() || at_end || !goes_on(up ? k + 1 : k - 1)) {
        break;
      }
    }
    const double seen = sides.left() + sides.right();
    score += seen > kSeen ? kLevelWeight * (sides.left() - sides.right()) / (seen + kPrior) : 0;
  };
  look(weights.level_floor, false);
  look(weights.level_ceiling, true);
  return 1 / (1 + std::exp(-score));
}

}  // namespace roomcut::weigh_faces
