// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/level_sides.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace roomcut::weigh_faces {
namespace {

constexpr double kPrior = 10;  // bins that the surface's evidence is worth against a face's own
constexpr double kLevel = 50;  // bins that the level's other surfaces are worth against one surface's own
constexpr double kGap = 0.4;   // weight of the gaps: suspended ceilings under a plenum forbid more
constexpr double kSteepness = 6;

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t face) {
  while (parent[face] != face) {
    parent[face] = parent[parent[face]];
    face = parent[face];
  }
  return face;
}

/// Per face the lowest face of the surface that it belongs to.
std::vector<std::size_t> surfaces(const CellComplex& complex, const FaceWeights& weights, std::size_t level) {
  std::vector<std::size_t> parent(complex.faces());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto covered = [&](std::size_t face) { return weights.is_level(complex.level_face(face, level)); };
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    if (complex.edges[e].left < 0 || complex.edges[e].right < 0) {
      continue;
    }
    auto a = static_cast<std::size_t>(complex.edges[e].left);
    auto b = static_cast<std::size_t>(complex.edges[e].right);
    const bool wall = (level > 0 && weights.is_wall(complex.wall_face(e, level - 1))) ||
                      (level < complex.layers() && weights.is_wall(complex.wall_face(e, level)));
    if (!wall && covered(a) && covered(b)) {
      a = root_of(parent, a);
      b = root_of(parent, b);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::size_t f = 0; f < parent.size(); ++f) {
    parent[f] = root_of(parent, f);
  }
  return parent;
}

/// What is beside the surface says: +1 a floor … -1 a ceiling. A few steps of a stair that pass a level make
/// no floor of what is a ceiling in the rest of the storey.
double prior_of(const LevelSides& surface, const LevelSides& level) {
  const double over = level.over - surface.over;
  const double under = level.under - surface.under;
  const double others = over + under;
  const double worth = kLevel * others / (others + kLevel);
  return (surface.over - surface.under + worth * (over - under) / (others + 1)) /
         (surface.over + surface.under + worth + 2);
}

}  // namespace

std::vector<double> floor_probability(const CellComplex& complex, const FaceWeights& weights,
                                      std::size_t level, const std::vector<LevelSides>& sides) {
  if (level == 0 || level == complex.layers()) {
    return std::vector<double>(sides.size(), level == 0 ? 1.0 : 0.0);  // beyond the box all is solid
  }
  const std::vector<std::size_t> surface = surfaces(complex, weights, level);
  std::vector<LevelSides> whole(sides.size());
  LevelSides total;
  for (std::size_t f = 0; f < sides.size(); ++f) {
    whole[surface[f]] += sides[f];
    total += sides[f];
  }
  std::vector<double> probability(sides.size());
  for (std::size_t f = 0; f < sides.size(); ++f) {
    const LevelSides& own = sides[f];
    const LevelSides& all = whole[surface[f]];
    const double beside =
        (own.over - own.under + kPrior * prior_of(all, total)) / (own.over + own.under + kPrior);
    const double gap = (all.open_over - all.open_under) / (all.open_over + all.open_under + 2);
    probability[f] = 1 / (1 + std::exp(-kSteepness * (beside + kGap * gap)));
  }
  return probability;
}

}  // namespace roomcut::weigh_faces
