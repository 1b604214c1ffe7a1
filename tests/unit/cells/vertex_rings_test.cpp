// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/vertex_rings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/cells/three_faces.h"

namespace roomcut {
namespace {

/// The ring turned so that it starts with `first`.
std::vector<std::int32_t> ring_from(const VertexRings& rings, std::size_t vertex, std::int32_t first) {
  const auto faces = rings.faces_around(vertex);
  std::vector<std::int32_t> ring(faces.begin(), faces.end());
  std::rotate(ring.begin(), std::find(ring.begin(), ring.end(), first), ring.end());
  return ring;
}

TEST(VertexRings, GoCounterClockwiseAroundEveryVertex) {
  const VertexRings rings = vertex_rings(three_faces());
  using Ring = std::vector<std::int32_t>;
  EXPECT_EQ(ring_from(rings, 7, 0), (Ring{0, 1, 2}));  // in the middle of face 0's side
  EXPECT_EQ(ring_from(rings, 0, -1), (Ring{-1, 0}));   // a corner of the box
  EXPECT_EQ(ring_from(rings, 1, -1), (Ring{-1, 1, 0}));
  EXPECT_EQ(ring_from(rings, 3, -1), (Ring{-1, 2, 1}));
  EXPECT_EQ(ring_from(rings, 5, -1), (Ring{-1, 0, 2}));
}

TEST(VertexRings, TheEdgeBesideAnEntrySeparatesItFromTheNext) {
  const CellComplex complex = three_faces();
  const VertexRings rings = vertex_rings(complex);
  for (std::size_t v = 0; v < complex.vertices.size(); ++v) {
    const auto faces = rings.faces_around(v);
    const auto edges = rings.edges_around(v);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const CellComplex::Edge& edge = complex.edges[edges[i]];
      EXPECT_EQ(std::minmax(edge.left, edge.right), std::minmax(faces[i], faces[(i + 1) % faces.size()]));
      EXPECT_TRUE(edge.v0 == static_cast<std::int32_t>(v) || edge.v1 == static_cast<std::int32_t>(v));
    }
  }
}

}  // namespace
}  // namespace roomcut
