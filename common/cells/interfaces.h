// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut {

/// A face of the product complex and the two cells it separates; kOutsideCell = beyond the bounding box
/// (solid).
struct Interface {
  static constexpr std::int64_t kOutsideCell = -1;
  bool wall;          ///< wall face or level face
  std::size_t index;  ///< wall_face(edge, layer) or level_face(face, level)
  std::int64_t a;     ///< wall: cell left of the edge; level: cell below
  std::int64_t b;     ///< wall: cell right of the edge; level: cell above
  double area;        ///< [m^2]
};

/// Calls f(Interface) once for every wall face and level face, in a fixed order: layer by layer from below,
/// within a layer its wall faces by edge; then level by level, by face. Allocates nothing per face.
template <class F>
void for_each_interface(const CellComplex& complex, F&& f) {
  const auto cell_of = [&](std::int32_t face, std::size_t layer) {
    return face < 0 ? Interface::kOutsideCell
                    : static_cast<std::int64_t>(complex.cell(static_cast<std::size_t>(face), layer));
  };
  std::vector<double> measure(complex.edges.size());
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    measure[e] = complex.length(e);
  }
  for (std::size_t k = 0; k < complex.layers(); ++k) {
    const double height = complex.height(k);
    for (std::size_t e = 0; e < complex.edges.size(); ++e) {
      f(Interface{true, complex.wall_face(e, k), cell_of(complex.edges[e].left, k),
                  cell_of(complex.edges[e].right, k), measure[e] * height});
    }
  }
  measure.resize(complex.faces());
  for (std::size_t i = 0; i < complex.faces(); ++i) {
    measure[i] = complex.area(i);
  }
  const std::size_t layers = complex.layers();
  for (std::size_t l = 0; l < complex.levels.size(); ++l) {
    for (std::size_t i = 0; i < complex.faces(); ++i) {
      const std::int64_t below =
          l == 0 ? Interface::kOutsideCell : static_cast<std::int64_t>(complex.cell(i, l - 1));
      const std::int64_t above =
          l == layers ? Interface::kOutsideCell : static_cast<std::int64_t>(complex.cell(i, l));
      f(Interface{false, complex.level_face(i, l), below, above, measure[i]});
    }
  }
}

/// Calls f(Interface, other cell or kOutsideCell) for every face of one cell. O(corners of its plan face).
template <class F>
void for_each_interface_of(const CellComplex& complex, std::size_t cell, F&& f) {
  const std::size_t face = complex.face_of(cell);
  const std::size_t layer = complex.layer_of(cell);
  const double height = complex.height(layer);
  const auto at = [&](std::int32_t neighbour) {
    return neighbour < 0 ? Interface::kOutsideCell
                         : static_cast<std::int64_t>(complex.cell(neighbour, layer));
  };
  for (const std::int32_t of_face : complex.edges_of(face)) {
    const auto e = static_cast<std::size_t>(of_face);
    const CellComplex::Edge& edge = complex.edges[e];
    const Interface wall{true, complex.wall_face(e, layer), at(edge.left), at(edge.right),
                         complex.length(e) * height};
    f(wall, wall.a == static_cast<std::int64_t>(cell) ? wall.b : wall.a);
  }
  const double area = complex.area(face);
  const auto self = static_cast<std::int64_t>(cell);
  const std::int64_t below =
      layer == 0 ? Interface::kOutsideCell : static_cast<std::int64_t>(complex.cell(face, layer - 1));
  const std::int64_t above = layer + 1 == complex.layers()
                                 ? Interface::kOutsideCell
                                 : static_cast<std::int64_t>(complex.cell(face, layer + 1));
  f(Interface{false, complex.level_face(face, layer), below, self, area}, below);
  f(Interface{false, complex.level_face(face, layer + 1), self, above, area}, above);
}

/// Whether the labelling has a surface at this face: one side empty, the other solid.
inline bool is_surface(const Interface& face, const std::vector<std::uint8_t>& label) {
  return is_empty(label, face.a) != is_empty(label, face.b);
}

/// The labels of the model itself, which has two sides only: what is unknown is solid.
inline std::vector<std::uint8_t> labels_of_model(std::vector<std::uint8_t> label) {
  std::replace(label.begin(), label.end(), Label::kUnknown, Label::kSolid);
  return label;
}

/// Whether the labels differ at this face. Unlike is_surface() also where unknown meets empty or solid: what
/// stands there matters once more is known.
inline bool separates(const Interface& face, const std::vector<std::uint8_t>& label) {
  return emptiness(label, face.a) != emptiness(label, face.b);
}

/// All faces of the model's surface, in the order of for_each_interface().
inline std::vector<Interface> surface_of(const CellComplex& complex, const std::vector<std::uint8_t>& label) {
  std::vector<Interface> surface;
  for_each_interface(complex, [&](const Interface& face) {
    if (is_surface(face, label)) {
      surface.push_back(face);
    }
  });
  return surface;
}

}  // namespace roomcut
