// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/welded_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace roomcut::extract {

namespace {

constexpr double kApart_m = 1e-7;  // crossings nearer to each other are one place

/// A floor or ceiling over an edge: its heights at both ends.
struct Trace {
  double from, to;
  double at(double t) const { return from + t * (to - from); }
};

/// The height of a floor or ceiling at one place, and where its knot is to be noted.
struct Height {
  double z;
  std::int32_t rank;  ///< whose height a knot gets: that of the lowest rank in it
  std::int64_t slot;  ///< 2 * (index into lower and upper) + (1 = upper)
};

class Welder {
 public:
  Welder(const EndHeights& heights, const Columns& columns)
      : heights_(heights), complex_(heights.complex()), columns_(columns), weld_(weld_distance(complex_)) {}

  WeldedColumns weld() {
    out_.places = complex_.vertices;
    find_crossings();
    list_corners();
    number_knots();
    return std::move(out_);
  }

 private:
  const Vec2& vertex(std::int32_t v) const { return complex_.vertices[static_cast<std::size_t>(v)]; }

  void find_crossings() {
    out_.crossing_offset = {static_cast<std::int64_t>(out_.places.size())};
    for (const CellComplex::Edge& edge : complex_.edges) {
      traces_.clear();
      bool sloped = false;
      for (const std::int32_t face : {edge.left, edge.right}) {
        if (face < 0) continue;
        for (std::size_t r = columns_.first(static_cast<std::size_t>(face));
             r < columns_.last(static_cast<std::size_t>(face)); ++r) {
          for (const RunEnd& end : {columns_.runs[r].lower, columns_.runs[r].upper}) {
            traces_.push_back({heights_.z(end, vertex(edge.v0)), heights_.z(end, vertex(edge.v1))});
            sloped = sloped || heights_.is_sloped(end);
          }
        }
      }
      if (sloped) {
        add_crossings(edge);
      }
      out_.crossing_offset.push_back(static_cast<std::int64_t>(out_.places.size()));
    }
  }

  /// Where two traces part by more than the weld at both ends, to different sides.
  void add_crossings(const CellComplex::Edge& edge) {
    crossings_.clear();
    for (std::size_t i = 0; i < traces_.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const double a = traces_[i].from - traces_[k].from;
        const double b = traces_[i].to - traces_[k].to;
        if (std::abs(a) > weld_ && std::abs(b) > weld_ && (a > 0) != (b > 0)) {
          crossings_.push_back(a / (a - b));
        }
      }
    }
    std::sort(crossings_.begin(), crossings_.end());
    const Vec2 along = vertex(edge.v1) - vertex(edge.v0);
    const double apart = kApart_m / along.norm();
    double last = -std::numeric_limits<double>::infinity();
    for (const double t : crossings_) {
      if (t - last > apart) {
        out_.places.push_back(vertex(edge.v0) + t * along);
        last = t;
      }
    }
  }

  void list_corners() {
    out_.corner_offset = {0};
    for (std::size_t face = 0; face < complex_.faces(); ++face) {
      const auto vertices = complex_.vertices_of(face);
      const auto edges = complex_.edges_of(face);
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        const auto e = static_cast<std::size_t>(edges[i]);
        add_corner(vertices[i], edges[i]);
        const std::int64_t first = out_.crossing_offset[e];
        const std::int64_t last = out_.crossing_offset[e + 1];
        const bool forward = complex_.edges[e].v0 == vertices[i];
        for (std::int64_t k = 0; k < last - first; ++k) {
          add_corner(static_cast<std::int32_t>(forward ? first + k : last - 1 - k), edges[i]);
        }
      }
      out_.corner_offset.push_back(static_cast<std::int64_t>(out_.corner_place.size()));
    }
    out_.knot_offset = {0};
    for (const Run& run : columns_.runs) {
      out_.knot_offset.push_back(out_.knot_offset.back() +
                                 static_cast<std::int64_t>(out_.corners(static_cast<std::size_t>(run.face))));
    }
  }

  void add_corner(std::int32_t place, std::int32_t edge) {
    out_.corner_place.push_back(place);
    out_.corner_edge.push_back(edge);
  }

  /// Along an edge the heights are straight between its ends: as find_crossings() saw them.
  double height(const RunEnd& end, std::int32_t place, std::int32_t edge) const {
    if (static_cast<std::size_t>(place) < complex_.vertices.size() || !heights_.is_sloped(end)) {
      return heights_.z(end, out_.places[static_cast<std::size_t>(place)]);
    }
    const Vec2& a = vertex(complex_.edges[static_cast<std::size_t>(edge)].v0);
    const Vec2& b = vertex(complex_.edges[static_cast<std::size_t>(edge)].v1);
    const double t = (out_.places[static_cast<std::size_t>(place)] - a).norm() / (b - a).norm();
    return Trace{heights_.z(end, a), heights_.z(end, b)}.at(t);
  }

  /// Levels before surfaces, level surfaces before sloped ones: the knots of one crease get the height of the
  /// same one of its two planes and lie on one straight line.
  std::int32_t rank(const RunEnd& end) const {
    const auto surfaces = static_cast<std::int32_t>(heights_.surfaces().surfaces.size());
    return end.surface < 0 ? -1 : end.surface + (heights_.is_sloped(end) ? surfaces : 0);
  }

  void number_knots() {
    out_.lower.resize(static_cast<std::size_t>(out_.knot_offset.back()));
    out_.upper.resize(out_.lower.size());
    std::vector<std::int64_t> offset;
    std::vector<Height> all = heights_by_place(offset);
    for (std::size_t place = 0; place < out_.places.size(); ++place) {
      add_knots(out_.places[place], all.begin() + offset[place], all.begin() + offset[place + 1]);
    }
  }

  template <class Visit>
  void for_each_height(const Visit& visit) const {
    for (std::size_t r = 0; r < columns_.runs.size(); ++r) {
      const Run& run = columns_.runs[r];
      const auto first = static_cast<std::size_t>(out_.corner_offset[static_cast<std::size_t>(run.face)]);
      for (std::size_t c = 0; c < out_.corners(static_cast<std::size_t>(run.face)); ++c) {
        const std::int64_t slot = 2 * (out_.knot_offset[r] + static_cast<std::int64_t>(c));
        visit(first + c, run.lower, slot);
        visit(first + c, run.upper, slot + 1);
      }
    }
  }

  std::vector<Height> heights_by_place(std::vector<std::int64_t>& offset) const {
    offset.assign(out_.places.size() + 1, 0);
    for_each_height([&](std::size_t corner, const RunEnd&, std::int64_t) {
      ++offset[static_cast<std::size_t>(out_.corner_place[corner]) + 1];
    });
    for (std::size_t place = 0; place < out_.places.size(); ++place) {
      offset[place + 1] += offset[place];
    }
    std::vector<Height> all(static_cast<std::size_t>(offset.back()));
    std::vector<std::int64_t> next(offset.begin(), offset.end() - 1);
    for_each_height([&](std::size_t corner, const RunEnd& end, std::int64_t slot) {
      const std::int32_t place = out_.corner_place[corner];
      all[static_cast<std::size_t>(next[static_cast<std::size_t>(place)]++)] = {
          height(end, place, out_.corner_edge[corner]), rank(end), slot};
    });
    return all;
  }

  void add_knots(const Vec2& place, std::vector<Height>::iterator first, std::vector<Height>::iterator last) {
    std::sort(first, last, [](const Height& a, const Height& b) {
      return std::tie(a.z, a.rank, a.slot) < std::tie(b.z, b.rank, b.slot);
    });
    while (first != last) {
      auto end = first;
      auto best = first;
      const auto knot = static_cast<std::int32_t>(out_.knots.size());
      for (double below = first->z; end != last && end->z - below <= weld_; ++end) {
        below = end->z;
        best = end->rank < best->rank ? end : best;
        (end->slot % 2 == 0 ? out_.lower : out_.upper)[static_cast<std::size_t>(end->slot / 2)] = knot;
      }
      out_.knots.emplace_back(place.x(), place.y(), best->z);
      first = end;
    }
  }

  const EndHeights& heights_;
  const CellComplex& complex_;
  const Columns& columns_;
  double weld_;
  WeldedColumns out_;
  std::vector<Trace> traces_;
  std::vector<double> crossings_;
};

}  // namespace

WeldedColumns weld_columns(const EndHeights& heights, const Columns& columns) {
  return Welder(heights, columns).weld();
}

}  // namespace roomcut::extract
