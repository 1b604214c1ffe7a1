// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/partition/to_complex.h"

namespace roomcut::partition {

void to_complex(const Subdivision& plan, CellComplex& complex) {
  const std::vector<std::int32_t> order = plan.faces_in_tree_order();
  std::vector<std::int32_t> face_number(plan.face_start.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) {
    face_number[order[i]] = static_cast<std::int32_t>(i);
  }
  const auto number_of = [&](std::int32_t face) {
    return face == Subdivision::kOutside ? -1 : face_number[face];
  };
  std::vector<std::int32_t> vertex_number(plan.vertices.size(), -1);
  std::vector<std::int32_t> edge_number(plan.half_edges.size() / 2, -1);
  const auto vertex_of = [&](std::int32_t vertex) {
    if (vertex_number[vertex] < 0) {
      vertex_number[vertex] = static_cast<std::int32_t>(complex.vertices.size());
      complex.vertices.push_back(plan.vertices[vertex]);
    }
    return vertex_number[vertex];
  };
  complex.face_offset.assign(1, 0);
  for (const std::int32_t face : order) {
    std::int32_t h = plan.face_start[face];
    do {
      const Subdivision::HalfEdge& half = plan.half_edges[h];
      const std::int32_t from = vertex_of(half.origin);
      std::int32_t& edge = edge_number[h / 2];
      if (edge < 0) {
        edge = static_cast<std::int32_t>(complex.edges.size());
        complex.edges.push_back({from, vertex_of(plan.target(h)), number_of(half.face),
                                 number_of(plan.half_edges[plan.twin(h)].face), half.line});
      }
      complex.face_vertex.push_back(from);
      complex.face_edge.push_back(edge);
      h = half.next;
    } while (h != plan.face_start[face]);
    complex.face_offset.push_back(static_cast<std::int64_t>(complex.face_vertex.size()));
  }
}

}  // namespace roomcut::partition
