// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/carried_layers.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>

#include "common/cells/interfaces.h"

namespace roomcut {
namespace {

constexpr float kSeen = 0.1F;  // coverage of a wall face: more than stray points and rims

/// Per line of the complex, then layer: whether there is anything on it.
std::vector<std::vector<bool>> find_carried(const CellComplex& complex, const FaceWeights& weights,
                                            const std::vector<std::uint8_t>& label) {
  std::vector<std::vector<bool>> carried(complex.lines.size(), std::vector<bool>(complex.layers(), false));
  for_each_interface(complex, [&](const Interface& face) {
    if (!face.wall) {
      return;
    }
    const std::int32_t line = complex.edges[face.index % complex.edges.size()].line;
    if (line >= 0 && (is_surface(face, label) || weights.wall_omega[face.index] >= kSeen)) {
      carried[static_cast<std::size_t>(line)][face.index / complex.edges.size()] = true;
    }
  });
  return carried;
}

}  // namespace

void restrict_to_carried_layers(const CellComplex& complex, const FaceWeights& weights,
                                const std::vector<std::uint8_t>& label, WallLines& lines) {
  const std::vector<std::vector<bool>> carried = find_carried(complex, weights, label);
  std::map<std::string, std::size_t> by_id;
  for (std::size_t i = 0; i < complex.lines.size(); ++i) {
    by_id.emplace(complex.lines[i].wall_id, i);
  }
  for (WallLine& wall : lines.lines) {
    const auto found = by_id.find(wall.id);
    if (found == by_id.end() || wall.locked || wall.source != LineSource::kDetected) {
      continue;
    }
    std::vector<int> layers;
    for (std::size_t k = 0; k < complex.layers(); ++k) {
      if (carried[found->second][k]) {
        layers.push_back(static_cast<int>(k));
      }
    }
    if (wall.levels) {
      std::vector<int> both;
      std::set_intersection(layers.begin(), layers.end(), wall.levels->begin(), wall.levels->end(),
                            std::back_inserter(both));
      layers = std::move(both);
    }
    if (!layers.empty() && layers.size() < complex.layers()) {
      wall.levels = std::move(layers);
    }
  }
}

}  // namespace roomcut
