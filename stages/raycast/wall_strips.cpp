// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/wall_strips.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace roomcut::raycast {
namespace {

constexpr double kThickest_m = 0.45;                            // between the faces of a wall
constexpr double kParallel_rad = 3.0 / 180 * std::numbers::pi;  // as two faces of a wall
constexpr double kStray_m2 = 1;  // that much of a strip must have been seen to say something of the rest

using LinePair = std::pair<std::int32_t, std::int32_t>;

double distance_apart(const CellComplex& complex, const CellComplex::Edge& a, const CellComplex::Edge& b) {
  const auto start = [&](const CellComplex::Edge& e) {
    return complex.vertices[static_cast<std::size_t>(e.v0)];
  };
  const auto along = [&](const CellComplex::Edge& e) {
    return Vec2(complex.vertices[static_cast<std::size_t>(e.v1)] - start(e)).normalized();
  };
  const Vec2 u = along(a);
  const Vec2 v = along(b);
  if (std::abs(u.x() * v.y() - u.y() * v.x()) > std::sin(kParallel_rad)) {
    return std::numeric_limits<double>::infinity();
  }
  const Vec2 to = start(b) - start(a);
  return std::abs(u.x() * to.y() - u.y() * to.x());
}

/// The closest two parallel lines that a face lies between; {-1, -1} = none as close as the faces of a wall.
LinePair lines_around(const CellComplex& complex, std::size_t face) {
  LinePair best{-1, -1};
  double closest = kThickest_m;
  const std::span<const std::int32_t> sides = complex.edges_of(face);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (std::size_t j = i + 1; j < sides.size(); ++j) {
      const CellComplex::Edge& a = complex.edges[static_cast<std::size_t>(sides[i])];
      const CellComplex::Edge& b = complex.edges[static_cast<std::size_t>(sides[j])];
      if (!complex.on_wall_line(a) || !complex.on_wall_line(b) || a.line == b.line) continue;
      if (const double apart = distance_apart(complex, a, b); apart < closest) {
        closest = apart;
        best = std::minmax(a.line, b.line);
      }
    }
  }
  return best;
}

struct Side {
  double length = 0;  // of the face along a line [m]
  double back = 0;    // how surely the line shows the cell a wall's back
};

Side side_of(const CellComplex& complex, const FaceWeights& weights, std::size_t face, std::size_t layer,
             std::int32_t line) {
  Side side;
  for (const std::int32_t edge : complex.edges_of(face)) {
    const auto e = static_cast<std::size_t>(edge);
    if (complex.edges[e].line == line) {
      const bool is_left = complex.edges[e].left == static_cast<std::int32_t>(face);
      const std::size_t w = complex.wall_face(e, layer);
      const double length = complex.length(e);
      side.length += length;
      side.back += length * (is_left ? weights.wall_right[w] : weights.wall_left[w]);
    }
  }
  side.back = side.length > 0 ? surface_probability(side.back / side.length) : 0;
  return side;
}

/// What was seen of one cell of a strip.
struct Piece {
  double area, wall, open;  // [m^2], share, share
};

Piece look_at(const CellComplex& complex, const FaceWeights& weights, const CellEvidence& evidence,
              std::size_t face, std::size_t layer, const LinePair& lines) {
  const Side a = side_of(complex, weights, face, layer, lines.first);
  const Side b = side_of(complex, weights, face, layer, lines.second);
  const double open = std::max(evidence.upright.fronts, evidence.front_m2 / evidence.total_m2);
  return {std::max(a.length, b.length) * complex.height(layer), a.back * b.back,
          open * (1 - std::max(a.back, b.back))};
}

}  // namespace

std::vector<double> walls_that_go_on(const CellComplex& complex, const FaceWeights& weights,
                                     const std::vector<CellEvidence>& evidence) {
  struct Seen {
    double wall = 0, open = 0;  // [m^2]
  };
  std::vector<LinePair> strip(complex.faces());
  std::map<LinePair, Seen> seen;
  std::vector<Piece> piece(complex.cells(), Piece{0, 0, 0});
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    strip[f] = lines_around(complex, f);
    for (std::size_t k = 0; strip[f].first >= 0 && k < complex.layers(); ++k) {
      const std::size_t c = complex.cell(f, k);
      piece[c] = look_at(complex, weights, evidence[c], f, k, strip[f]);
      Seen& of_strip = seen[strip[f]];
      of_strip.wall += piece[c].area * piece[c].wall;
      of_strip.open += piece[c].area * piece[c].open;
    }
  }
  std::vector<double> goes_on(complex.cells(), 0);
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    for (std::size_t k = 0; strip[f].first >= 0 && k < complex.layers(); ++k) {
      const std::size_t c = complex.cell(f, k);
      const Seen& s = seen[strip[f]];
      goes_on[c] = s.wall / (s.wall + s.open + kStray_m2) * (1 - std::max(piece[c].wall, piece[c].open));
    }
  }
  return goes_on;
}

}  // namespace roomcut::raycast
