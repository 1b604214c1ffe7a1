// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/graphcut/manifold_by_mesh.h"

#include <map>

#include "common/cells/interfaces.h"

namespace roomcut::graphcut {

namespace {

using Vertex = std::pair<int, int>;  // level, plan vertex
using Segment = std::pair<Vertex, Vertex>;

std::vector<Vertex> polygon_of(const CellComplex& complex, const Interface& face) {
  std::vector<Vertex> polygon;
  if (face.wall) {
    const CellComplex::Edge& edge = complex.edges[complex.edge_of_wall(face.index)];
    const int k = static_cast<int>(complex.layer_of_wall(face.index));
    polygon = {{k, edge.v0}, {k, edge.v1}, {k + 1, edge.v1}, {k + 1, edge.v0}};
  } else {
    for (const std::int32_t vertex : complex.vertices_of(complex.face_of_level(face.index))) {
      polygon.emplace_back(static_cast<int>(complex.level_of(face.index)), vertex);
    }
  }
  return polygon;
}

}  // namespace

std::set<std::pair<int, int>> non_manifold_vertices(const CellComplex& complex,
                                                    const std::vector<std::uint8_t>& label) {
  std::map<Segment, std::vector<int>> faces_of_segment;
  std::map<Vertex, std::set<int>> faces_of_vertex;
  int number = 0;
  for (const Interface& face : surface_of(complex, label)) {
    const std::vector<Vertex> polygon = polygon_of(complex, face);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto ends = std::minmax(polygon[i], polygon[(i + 1) % polygon.size()]);
      faces_of_segment[Segment(ends.first, ends.second)].push_back(number);
      faces_of_vertex[polygon[i]].insert(number);
    }
    ++number;
  }
  std::set<Vertex> bad;
  std::map<Vertex, std::map<int, std::vector<int>>>
      beside;  // vertex -> face -> faces across segments at the vertex
  for (const auto& [segment, faces] : faces_of_segment) {
    for (const Vertex& end : {segment.first, segment.second}) {
      if (faces.size() != 2) {
        bad.insert(end);
      }
      for (const int a : faces) {
        for (const int b : faces) {
          beside[end][a].push_back(b);
        }
      }
    }
  }
  for (const auto& [vertex, faces] : faces_of_vertex) {
    std::set<int> reached{*faces.begin()};
    std::vector<int> open{*faces.begin()};
    while (!open.empty()) {
      const int face = open.back();
      open.pop_back();
      for (const int next : beside[vertex][face]) {
        if (reached.insert(next).second) {
          open.push_back(next);
        }
      }
    }
    if (reached.size() != faces.size()) {
      bad.insert(vertex);
    }
  }
  return bad;
}

}  // namespace roomcut::graphcut
