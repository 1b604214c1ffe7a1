// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "common/cells/cell_complex.h"

namespace roomcut {

namespace {

/// Rounding of coordinates may bend a straight side by this much [m]; three orders below kPlanSnap_m.
constexpr double kStraight_m = 1e-8;

std::string at(const char* what, std::size_t index, const char* violation) {
  return std::string(what) + " " + std::to_string(index) + ": " + violation;
}

bool in_range(std::int64_t index, std::size_t size) {
  return index >= 0 && static_cast<std::size_t>(index) < size;
}

std::string check_levels(const CellComplex& complex) {
  if (complex.levels.size() < 2) {
    return "fewer than two levels";
  }
  for (std::size_t l = 0; l < complex.levels.size(); ++l) {
    if (!std::isfinite(complex.levels[l])) {
      return at("level", l, "not finite");
    }
    if (l > 0 && complex.levels[l] <= complex.levels[l - 1]) {
      return at("level", l, "not above the one before");
    }
  }
  return "";
}

std::string check_lines(const CellComplex& complex) {
  for (std::size_t i = 0; i < complex.lines.size(); ++i) {
    const CellComplex::Line& line = complex.lines[i];
    if (!std::isfinite(line.line.theta + line.line.d + line.t0 + line.t1) || line.t0 > line.t1) {
      return at("line", i, "not finite, or its support is turned round");
    }
    if (line.plane < -1 || line.plane >= static_cast<std::int64_t>(complex.planes.size())) {
      return at("line", i, "plane out of range");
    }
    for (std::size_t k = 0; k < line.layers.size(); ++k) {
      if (!in_range(line.layers[k], complex.layers()) || (k > 0 && line.layers[k] <= line.layers[k - 1])) {
        return at("line", i, "layers out of range or order");
      }
    }
  }
  return "";
}

std::string check_edges(const CellComplex& complex) {
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const CellComplex::Edge& edge = complex.edges[e];
    if (!in_range(edge.v0, complex.vertices.size()) || !in_range(edge.v1, complex.vertices.size()) ||
        edge.v0 == edge.v1) {
      return at("edge", e, "vertices out of range or equal");
    }
    const bool outside = edge.left < 0 || edge.right < 0;
    if (edge.left < -1 || edge.right < -1 || edge.left >= static_cast<std::int64_t>(complex.faces()) ||
        edge.right >= static_cast<std::int64_t>(complex.faces()) || edge.left == edge.right) {
      return at("edge", e, "faces out of range or equal");
    }
    if (edge.line < -1 || edge.line >= static_cast<std::int64_t>(complex.lines.size())) {
      return at("edge", e, "line out of range");
    }
    if (outside != (edge.line < 0)) {
      return at("edge", e, "the sides of the bounding box, and only they, have no line");
    }
    if (edge.line >= 0) {
      const Line2& line = complex.lines[edge.line].line;
      const double off = std::max(std::abs(line.distance(complex.vertices[edge.v0])),
                                  std::abs(line.distance(complex.vertices[edge.v1])));
      if (off > 1.01 * kPlanSnap_m) {
        return at("edge", e, "does not lie on its line");
      }
    }
  }
  return "";
}

/// One corner of face f, from face_vertex[i] to `to`: its edge joins the two and has f on this side, and no
/// other corner has that side. `used`: two sides per edge.
std::string check_corner(const CellComplex& complex, std::size_t f, std::int64_t i, std::int32_t to,
                         std::vector<std::uint8_t>& used) {
  const std::int32_t from = complex.face_vertex[i];
  if (!in_range(from, complex.vertices.size()) || !in_range(complex.face_edge[i], complex.edges.size())) {
    return at("face", f, "corner out of range");
  }
  const auto e = static_cast<std::size_t>(complex.face_edge[i]);
  const CellComplex::Edge& edge = complex.edges[e];
  const bool along = edge.v0 == from && edge.v1 == to;
  if (!along && !(edge.v0 == to && edge.v1 == from)) {
    return at("face", f, "an edge does not join its corners");
  }
  if ((along ? edge.left : edge.right) != static_cast<std::int32_t>(f)) {
    return at("face", f, "an edge names another face on this side");
  }
  if (used[2 * e + (along ? 0 : 1)]++ != 0) {
    return at("edge", e, "one side belongs to two corners");
  }
  return "";
}

/// Offsets, index ranges, and that every side of every edge belongs to exactly one corner of the face it
/// names.
std::string check_corners(const CellComplex& complex) {
  if (complex.face_offset.empty() || complex.faces() == 0 || complex.face_offset.front() != 0 ||
      complex.face_offset.back() != static_cast<std::int64_t>(complex.face_vertex.size()) ||
      complex.face_edge.size() != complex.face_vertex.size()) {
    return "face offsets do not fit the corners";
  }
  std::vector<std::uint8_t> used(2 * complex.edges.size(), 0);
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    const std::int64_t begin = complex.face_offset[f];
    const std::int64_t end = complex.face_offset[f + 1];
    if (begin < 0 || end < begin + 3 || end > complex.face_offset.back()) {
      return at("face", f, "fewer than three corners");
    }
    for (std::int64_t i = begin; i < end; ++i) {
      const std::int32_t to = complex.face_vertex[i + 1 == end ? begin : i + 1];
      if (std::string violation = check_corner(complex, f, i, to, used); !violation.empty()) {
        return violation;
      }
    }
  }
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    if (used[2 * e] != (complex.edges[e].left >= 0 ? 1 : 0) ||
        used[2 * e + 1] != (complex.edges[e].right >= 0 ? 1 : 0)) {
      return at("edge", e, "names a face that does not have it");
    }
  }
  return "";
}

std::string check_convex(const CellComplex& complex) {
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    const FaceCorners corners = complex.corners(f);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2& p = corners.after(i);
      const Vec2 a = p - corners[i];
      const Vec2 b = corners.after(i + 1 < corners.size() ? i + 1 : 0) - p;
      // How far the shorter side's end lies to the right of the longer side's line.
      if (a.x() * b.y() - a.y() * b.x() <
          -kStraight_m * std::sqrt(std::max(a.squaredNorm(), b.squaredNorm()))) {
        return at("face", f, "not convex, or clockwise");
      }
    }
    if (!(complex.area(f) > 0)) {
      return at("face", f, "no area");
    }
  }
  return "";
}

/// With every side matched, Euler's number and the area leave no room for gaps, overlaps or loose parts.
std::string check_tiling(const CellComplex& complex) {
  Vec2 low = complex.vertices.front();
  Vec2 high = low;
  for (const Vec2& p : complex.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const CellComplex::Edge& edge = complex.edges[e];
    if (edge.line >= 0) {
      continue;
    }
    const Vec2& p = complex.vertices[edge.v0];
    const Vec2& q = complex.vertices[edge.v1];
    const bool on_side = (p.x() == q.x() && (p.x() == low.x() || p.x() == high.x())) ||
                         (p.y() == q.y() && (p.y() == low.y() || p.y() == high.y()));
    if (!on_side) {
      return at("edge", e, "has no line, but is no side of the bounding box");
    }
  }
  double area = 0;
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    area += complex.area(f);
  }
  const double box = (high - low).prod();
  if (!(std::abs(area - box) <= 1e-9 * box + 1e-12)) {
    return "the faces do not fill the bounding box";
  }
  if (complex.vertices.size() + complex.faces() != complex.edges.size() + 1) {
    return "vertices - edges + faces is not 1";
  }
  return "";
}

std::string check_vertices(const CellComplex& complex) {
  std::vector<std::uint8_t> used(complex.vertices.size(), 0);
  for (const std::int32_t v : complex.face_vertex) {
    used[v] = 1;
  }
  for (std::size_t v = 0; v < complex.vertices.size(); ++v) {
    if (!complex.vertices[v].allFinite()) {
      return at("vertex", v, "not finite");
    }
    if (used[v] == 0) {
      return at("vertex", v, "belongs to no face");
    }
  }
  return "";
}

}  // namespace

std::string find_violation(const CellComplex& complex) {
  for (const auto check :
       {check_levels, check_lines, check_edges, check_corners, check_vertices, check_convex, check_tiling}) {
    std::string violation = check(complex);
    if (!violation.empty()) {
      return violation;
    }
  }
  return "";
}

}  // namespace roomcut
