// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/cell_surface.h"

#include <algorithm>
#include <cmath>

namespace roomcut::extract {

namespace {

constexpr std::int64_t kVertical = -1;  // carrier of all upright edges: two that meet share their plan vertex

class SurfaceMaker {
 public:
  SurfaceMaker(const CellComplex& complex, const std::vector<std::uint8_t>& label, const Storeys& storeys)
      : complex_(complex), label_(label), storeys_(storeys) {}

  FacetSurface make() {
    for (const double z : complex_.levels) {
      for (const Vec2& p : complex_.vertices) {
        surface_.vertices.emplace_back(p.x(), p.y(), z);
      }
    }
    for (std::size_t l = 0; l < complex_.levels.size(); ++l) {
      for (std::size_t f = 0; f < complex_.faces(); ++f) {
        add_level_face(f, l);
      }
    }
    for (std::size_t k = 0; k < complex_.layers(); ++k) {
      for (std::size_t e = 0; e < complex_.edges.size(); ++e) {
        add_wall_face(e, k);
      }
    }
    return std::move(surface_);
  }

 private:
  bool empty(std::int32_t face, std::size_t layer) const {
    return layer < complex_.layers() && is_empty(complex_, label_, face, layer);
  }

  std::int16_t storey(std::int32_t face, std::size_t layer) const {
    return storeys_.of_cell[complex_.cell(static_cast<std::size_t>(face), layer)];
  }

  std::int32_t vertex(std::int32_t v, std::size_t level) const {
    return static_cast<std::int32_t>(level * complex_.vertices.size()) + v;
  }

  // The wall line of an edge, or after all lines one of the four sides of the bounding box.
  std::int64_t carrier(std::int32_t e) const {
    const CellComplex::Edge& edge = complex_.edges[static_cast<std::size_t>(e)];
    if (edge.line >= 0) {
      return edge.line;
    }
    Vec2 along = complex_.vertices[static_cast<std::size_t>(edge.v1)] -
                 complex_.vertices[static_cast<std::size_t>(edge.v0)];
    if (edge.left < 0) {
      along = -along;  // the building on the left
    }
    const bool horizontal = std::abs(along.x()) > std::abs(along.y());
    const int side = horizontal ? (along.x() > 0 ? 0 : 2) : (along.y() > 0 ? 1 : 3);
    return static_cast<std::int64_t>(complex_.lines.size()) + side;
  }

  void add_level_face(std::size_t f, std::size_t level) {
    const auto face = static_cast<std::int32_t>(f);
    const bool above = empty(face, level);
    const bool below = level > 0 && empty(face, level - 1);
    if (above == below) {
      return;
    }
    corners_.clear();
    carriers_.clear();
    for (const std::int32_t v : complex_.vertices_of(f)) {
      corners_.push_back(vertex(v, level));
    }
    for (const std::int32_t e : complex_.edges_of(f)) {
      carriers_.push_back(carrier(e));
    }
    if (above) {  // a floor: its normal points down, out of the empty cell
      std::reverse(corners_.begin(), corners_.end());
      std::reverse(carriers_.begin(),
                   carriers_.end() - 1);  // the edge from corner i to i + 1 is the old one before it
    }
    const std::int64_t plane = -1 - 2 * static_cast<std::int64_t>(level) - (above ? 1 : 0);
    surface_.add(corners_, carriers_, plane, above ? SurfaceKind::kFloor : SurfaceKind::kCeiling,
                 storey(face, above ? level : level - 1));
  }

  void add_wall_face(std::size_t e, std::size_t layer) {
    const CellComplex::Edge& edge = complex_.edges[e];
    const bool left = empty(edge.left, layer);
    if (left == empty(edge.right, layer)) {
      return;
    }
    const std::int32_t from = left ? edge.v0 : edge.v1;  // the normal points to the right of from -> to
    const std::int32_t to = left ? edge.v1 : edge.v0;
    const std::int64_t line = carrier(static_cast<std::int32_t>(e));
    bool positive = true;
    if (edge.line >= 0) {
      const Vec2 along =
          complex_.vertices[static_cast<std::size_t>(to)] - complex_.vertices[static_cast<std::size_t>(from)];
      positive = complex_.lines[static_cast<std::size_t>(edge.line)].line.direction().dot(along) > 0;
    }
    corners_ = {vertex(from, layer), vertex(to, layer), vertex(to, layer + 1), vertex(from, layer + 1)};
    carriers_ = {line, kVertical, line, kVertical};
    surface_.add(corners_, carriers_, 2 * line + (positive ? 1 : 0), SurfaceKind::kWall,
                 storey(left ? edge.left : edge.right, layer));
  }

  const CellComplex& complex_;
  const std::vector<std::uint8_t>& label_;
  const Storeys& storeys_;
  FacetSurface surface_;
  std::vector<std::int32_t> corners_;
  std::vector<std::int64_t> carriers_;
};

}  // namespace

FacetSurface surface_of_labels(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                               const Storeys& storeys) {
  return SurfaceMaker(complex, label, storeys).make();
}

double empty_volume(const CellComplex& complex, const std::vector<std::uint8_t>& label) {
  double sum = 0;
  for_each_run(complex, label, [&](std::size_t face, std::size_t first, std::size_t last) {
    sum += complex.area(face) * (complex.levels[last] - complex.levels[first]);
  });
  return sum;
}

}  // namespace roomcut::extract
