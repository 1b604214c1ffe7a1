// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/cells/vertex_rings.h"

namespace roomcut {

/// A vertex of the product complex: plan vertex and level.
struct Place {
  std::int32_t level, vertex;
  auto operator<=>(const Place&) const = default;
};

/// Decides, at every place, whether the surface between the labels is a 2-manifold there: the empty cells
/// around it are connected through faces that meet it, and so are the solid ones (the outside is solid). That
/// covers the edges too: where cells touch diagonally at an edge, both pairs would have to be joined around
/// one end of the edge by paths that cross on the sphere around it.
class ManifoldCheck {
 public:
  explicit ManifoldCheck(const CellComplex& complex);

  bool is_manifold(const Place& place, const std::vector<std::uint8_t>& label) const;
  /// All places that are not manifold, ascending.
  std::vector<Place> find_all(const std::vector<std::uint8_t>& label) const;

  const CellComplex& complex() const { return complex_; }
  const VertexRings& rings() const { return rings_; }

 private:
  const CellComplex& complex_;
  VertexRings rings_;
};

}  // namespace roomcut
