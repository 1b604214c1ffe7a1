// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut {

/// The plan faces around every plan vertex, counter-clockwise. A vertex on the bounding box has one entry
/// kOutsideFace for everything beyond the box. In the product complex the cells around (vertex, level l) are
/// the ring's faces in layers l - 1 and l.
struct VertexRings {
  static constexpr std::int32_t kOutsideFace = -1;
  std::vector<std::int64_t> offset;  ///< vertices + 1
  std::vector<std::int32_t> face;    ///< faces of the rings, or kOutsideFace
  std::vector<std::int32_t> edge;    ///< parallel: the edge between this entry and the next one of the ring

  std::span<const std::int32_t> faces_around(std::size_t vertex) const {
    return {face.data() + offset[vertex], static_cast<std::size_t>(offset[vertex + 1] - offset[vertex])};
  }
  std::span<const std::int32_t> edges_around(std::size_t vertex) const {
    return {edge.data() + offset[vertex], static_cast<std::size_t>(offset[vertex + 1] - offset[vertex])};
  }
};

/// Linear in the size of the complex, which must be free of violations (find_violation()).
VertexRings vertex_rings(const CellComplex& complex);

}  // namespace roomcut
