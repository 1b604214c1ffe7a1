// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/wall_sides.h"

#include <cmath>
#include <vector>

#include "common/cells/plan_walk.h"

namespace roomcut {
namespace {

constexpr double kSeen = 0.15;      // coverage of a floor or ceiling on either side: enough to ask
constexpr double kContinues = 0.3;  // coverage with which a wall goes on into the next layer
constexpr double kPrior = 0.1;      // coverage below which neither side is believed
constexpr double kLevelWeight = 5;  // log-odds of a floor that is whole on one side and missing on the other
constexpr double kStripWeight = 5;  // the same for the strips
constexpr double kStripPrior = 2;   // columns

}  // namespace

double left_probability(const CellComplex& complex, const FaceWeights& weights, std::size_t edge,
                        std::size_t layer, const StripCounts& strips, double beside_m) {
  const std::int32_t left_face = walk_beside(complex, edge, true, beside_m);
  const std::int32_t right_face = walk_beside(complex, edge, false, beside_m);
  double score = kStripWeight * (strips.left - strips.right) / (strips.left + strips.right + kStripPrior);
  const auto ask = [&](const std::vector<float>& kind, std::size_t level) {
    const auto on = [&](std::int32_t face) {
      return face < 0 ? 0.0 : kind[complex.level_face(static_cast<std::size_t>(face), level)];
    };
    const double left = on(left_face);
    const double right = on(right_face);
    score += left + right > kSeen ? kLevelWeight * (left - right) / (left + right + kPrior) : 0;
    return left + right > kSeen;
  };
  const auto goes_on = [&](std::size_t k) {
    return weights.wall_omega[complex.wall_face(edge, k)] > kContinues;
  };
  for (std::size_t l = layer; !ask(weights.level_floor, l) && l > 0 && goes_on(l - 1); --l) {
  }
  for (std::size_t l = layer + 1; !ask(weights.level_ceiling, l) && l < complex.layers() && goes_on(l); ++l) {
  }
  return 1 / (1 + std::exp(-score));
}

}  // namespace roomcut
