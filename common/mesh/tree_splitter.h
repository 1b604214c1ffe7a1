// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace roomcut {

/// Orders triangles so that those of a part of a tree of boxes follow each other.
class TreeSplitter {
 public:
  using Box = Eigen::AlignedBox3d;

  /// `order`: indices of triangles of the mesh, sorted as splits go on; it must outlive this.
  TreeSplitter(const TriangleMesh& mesh, std::vector<std::int32_t>& order);

  /// The box around the triangles order[first … last), larger by a nanometre: rays in the plane of a flat box
  /// must not be lost by rounding.
  Box box_of(std::int32_t first, std::int32_t last) const;

  /// Parts order[first … last), two or more, in two, neither of them empty; returns where the second part
  /// begins. By the surface area heuristic over bins (Wald 2007, On fast construction of SAH-based bounding
  /// volume hierarchies); in halves where no plane parts them or where `depth`, the splits above, is large.
  std::int32_t split(std::int32_t first, std::int32_t last, int depth);

 private:
  static constexpr int kBins = 16;
  using Counts = std::array<std::int32_t, kBins>;

  static int cheapest_split(const std::array<Box, kBins>& box, const Counts& count);
  std::int32_t halve(std::int32_t first, std::int32_t last, int axis);
  std::size_t triangle(std::int32_t i) const {
    return static_cast<std::size_t>(order_[static_cast<std::size_t>(i)]);
  }
  double centre(std::int32_t t, int axis) const { return centres_[static_cast<std::size_t>(t)][axis]; }

  std::vector<std::int32_t>& order_;
  std::vector<Box> boxes_;     ///< per triangle of the mesh
  std::vector<Vec3> centres_;  ///< of the boxes
};

}  // namespace roomcut
