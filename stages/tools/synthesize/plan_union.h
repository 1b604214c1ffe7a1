// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/errors/error.h"
#include "stages/tools/synthesize/building.h"

namespace roomcut::synthesize {

/// The plan of the union of prisms: a triangulation of the plane in which every triangle lies in one region,
/// and every region is either empty or solid in each layer between two neighbouring heights. Where emptiness
/// begins or ends at a height, a slope may stand for it, which lies on the empty side of it. Surfaces of one
/// region, and of two with a common edge, do not cross inside them.
struct PlanUnion {
  /// z = gradient · p + c
  struct Slope {
    Vec2 gradient{0, 0};
    double c = 0;
  };
  static constexpr double kSame = 5e-6;  ///< surfaces that are closer at a corner meet there [m]

  std::vector<double> heights;  ///< ascending; layer k lies between heights k and k + 1
  std::vector<Vec2> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< counter-clockwise
  std::vector<std::int32_t> triangle_region;
  struct Edge {
    std::int32_t v0, v1;
    std::int32_t left, right;  ///< regions
  };
  std::vector<Edge> edges;               ///< between different regions
  std::vector<std::vector<char>> empty;  ///< per region and layer; region 0 is solid in all
  std::vector<Slope> slopes;
  /// Per region and height: the surface there, a height by its index or a slope by heights.size() + its
  /// index.
  std::vector<std::vector<std::int32_t>> surface;

  double height(std::int32_t surface_index, const Vec2& p) const {
    const auto i = static_cast<std::size_t>(surface_index);
    if (i < heights.size()) return heights[i];
    const Slope& slope = slopes[i - heights.size()];
    return slope.gradient.dot(p) + slope.c;
  }
  /// Whether emptiness begins or ends there.
  bool changes(std::int32_t region, std::size_t height) const {
    const auto layer = static_cast<std::ptrdiff_t>(height);
    return is_empty(region, layer - 1) != is_empty(region, layer);
  }

  bool is_empty(std::int32_t region, std::ptrdiff_t layer) const {
    return layer >= 0 && layer < static_cast<std::ptrdiff_t>(heights.size()) - 1 && empty[region][layer] != 0;
  }
};

/// Overlays the prisms' plans (corners within 1 µm are one), labels each piece, drops the borders that
/// separate nothing, and triangulates what is left. Problems of the scene (see make_truth) are appended to
/// `problems`.
PlanUnion unite(const Scene& scene, const Building& building, std::vector<Problem>& problems);

}  // namespace roomcut::synthesize
