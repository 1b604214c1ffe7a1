// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/plan/plan_complex.h"

#include <utility>

namespace roomcut {

namespace {

/// Fills in what lies beyond the sides of the rectangle: one half-edge leaves every vertex there.
void link_outside(std::vector<Subdivision::HalfEdge>& half_edges, std::size_t vertices) {
  std::vector<std::int32_t> leaving(vertices, -1);
  for (std::size_t h = 0; h < half_edges.size(); ++h) {
    if (half_edges[h].face == Subdivision::kOutside) {
      leaving[half_edges[h].origin] = static_cast<std::int32_t>(h);
    }
  }
  for (std::size_t h = 0; h < half_edges.size(); ++h) {
    if (half_edges[h].face == Subdivision::kOutside) {
      half_edges[h].next = leaving[half_edges[h ^ 1].origin];
      half_edges[half_edges[h].next].prev = static_cast<std::int32_t>(h);
    }
  }
}

}  // namespace

Subdivision plan_of(const CellComplex& complex) {
  std::vector<Subdivision::HalfEdge> half_edges;
  for (const CellComplex::Edge& edge : complex.edges) {
    half_edges.push_back({edge.v0, -1, -1, edge.left, edge.line});
    half_edges.push_back({edge.v1, -1, -1, edge.right, edge.line});
  }
  std::vector<std::int32_t> face_start;
  for (std::size_t face = 0; face < complex.faces(); ++face) {
    const std::int64_t begin = complex.face_offset[face];
    const std::int64_t end = complex.face_offset[face + 1];
    const auto half_edge = [&](std::int64_t i) {
      const std::int32_t edge = complex.face_edge[i];
      return 2 * edge + (complex.edges[edge].v0 == complex.face_vertex[i] ? 0 : 1);
    };
    for (std::int64_t i = begin; i < end; ++i) {
      const std::int32_t next = half_edge(i + 1 < end ? i + 1 : begin);
      half_edges[half_edge(i)].next = next;
      half_edges[next].prev = half_edge(i);
    }
    face_start.push_back(half_edge(begin));
  }
  link_outside(half_edges, complex.vertices.size());
  return {complex.vertices, std::move(half_edges), std::move(face_start)};
}

void set_plan(const Subdivision& plan, const std::vector<std::int32_t>& faces, CellComplex& complex) {
  std::vector<std::int32_t> face_number(plan.face_start.size(), -1);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    face_number[faces[i]] = static_cast<std::int32_t>(i);
  }
  const auto number_of = [&](std::int32_t face) {
    return face == Subdivision::kOutside ? -1 : face_number[face];
  };
  std::vector<std::int32_t> vertex_number(plan.vertices.size(), -1);
  std::vector<std::int32_t> edge_number(plan.half_edges.size() / 2, -1);
  complex.vertices.clear();
  const auto vertex_of = [&](std::int32_t vertex) {
    if (vertex_number[vertex] < 0) {
      vertex_number[vertex] = static_cast<std::int32_t>(complex.vertices.size());
      complex.vertices.push_back(plan.vertices[vertex]);
    }
    return vertex_number[vertex];
  };
  complex.face_offset.assign(1, 0);
  complex.face_vertex.clear();
  complex.face_edge.clear();
  complex.edges.clear();
  for (const std::int32_t face : faces) {
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

}  // namespace roomcut
