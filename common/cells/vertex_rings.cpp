// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/vertex_rings.h"

namespace roomcut {

namespace {

/// Where a face's corner stands: the corner itself and the one before it in the same face.
struct Corners {
  std::vector<std::int64_t> before;   ///< corner -> previous corner of its face
  std::vector<std::int32_t> face_of;  ///< corner -> face
  std::vector<std::int64_t>
      leaving;  ///< 2 * edge + (0 = along v0 -> v1, 1 = against): the corner it leaves; -1 = none
  std::vector<std::int64_t> first;  ///< vertex -> the corner to start at
};

std::size_t directed(const CellComplex& complex, std::int32_t edge, std::int32_t from) {
  return 2 * static_cast<std::size_t>(edge) + (complex.edges[edge].v0 == from ? 0 : 1);
}

Corners corners_of(const CellComplex& complex) {
  Corners corners;
  corners.before.resize(complex.face_vertex.size());
  corners.face_of.resize(complex.face_vertex.size());
  corners.leaving.assign(2 * complex.edges.size(), -1);
  corners.first.assign(complex.vertices.size(), -1);
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    const std::int64_t begin = complex.face_offset[f];
    const std::int64_t end = complex.face_offset[f + 1];
    for (std::int64_t i = begin; i < end; ++i) {
      corners.before[i] = i == begin ? end - 1 : i - 1;
      corners.face_of[i] = static_cast<std::int32_t>(f);
      const std::int32_t vertex = complex.face_vertex[i];
      corners.leaving[directed(complex, complex.face_edge[i], vertex)] = i;
      // A ring on the bounding box starts where the box's inside starts, so that it ends at the outside.
      const CellComplex::Edge& edge = complex.edges[complex.face_edge[i]];
      if (corners.first[vertex] < 0 || edge.left < 0 || edge.right < 0) {
        corners.first[vertex] = i;
      }
    }
  }
  return corners;
}

}  // namespace

VertexRings vertex_rings(const CellComplex& complex) {
  const Corners corners = corners_of(complex);
  VertexRings rings;
  rings.offset.reserve(complex.vertices.size() + 1);
  rings.face.reserve(complex.face_vertex.size() + 64);
  rings.edge.reserve(complex.face_vertex.size() + 64);
  for (std::size_t v = 0; v < complex.vertices.size(); ++v) {
    rings.offset.push_back(static_cast<std::int64_t>(rings.face.size()));
    const std::int64_t start = corners.first[v];
    for (std::int64_t corner = start; corner >= 0;) {
      // Turning counter-clockwise about the vertex, a face is left across the edge that arrives at the
      // vertex.
      const std::int32_t arriving = complex.face_edge[corners.before[corner]];
      rings.face.push_back(corners.face_of[corner]);
      rings.edge.push_back(arriving);
      corner = corners.leaving[directed(complex, arriving, static_cast<std::int32_t>(v))];
      if (corner < 0) {
        rings.face.push_back(VertexRings::kOutsideFace);
        rings.edge.push_back(complex.face_edge[start]);
      }
      if (corner == start) {
        break;
      }
    }
  }
  rings.offset.push_back(static_cast<std::int64_t>(rings.face.size()));
  return rings;
}

}  // namespace roomcut
