// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/column_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace roomcut::extract {

namespace {

constexpr std::int64_t kVertical = -1;  // carrier of all upright edges: two that meet share their place

/// Where a floor or ceiling runs over an edge: its knots at both ends.
using Trace = std::pair<std::int32_t, std::int32_t>;

bool is_below(const Trace& a, const Trace& b) {
  return a.first <= b.first && a.second <= b.second;
}

/// A run beside an edge.
struct Beside {
  Trace low, high;
  std::int16_t storey;
};

class SurfaceMaker {
 public:
  SurfaceMaker(const EndHeights& heights, const Columns& columns, const WeldedColumns& welded)
      : heights_(heights), complex_(heights.complex()), columns_(columns), welded_(welded) {}

  ColumnSurface make() {
    out_.facets.vertices = welded_.knots;
    for (std::size_t r = 0; r < columns_.runs.size(); ++r) {
      add_ends(r);
    }
    find_sides();
    for (std::size_t e = 0; e < complex_.edges.size(); ++e) {
      add_walls(e);
    }
    return std::move(out_);
  }

 private:
  const Vec2& vertex(std::int32_t v) const { return complex_.vertices[static_cast<std::size_t>(v)]; }

  /// The wall line of an edge, or after all lines one of the four sides of the bounding box.
  std::int64_t carrier(std::int32_t e) const {
    const CellComplex::Edge& edge = complex_.edges[static_cast<std::size_t>(e)];
    if (edge.line >= 0) {
      return edge.line;
    }
    Vec2 along = vertex(edge.v1) - vertex(edge.v0);
    if (edge.left < 0) {
      along = -along;  // the building on the left
    }
    const bool horizontal = std::abs(along.x()) > std::abs(along.y());
    const int side = horizontal ? (along.x() > 0 ? 0 : 2) : (along.y() > 0 ? 1 : 3);
    return static_cast<std::int64_t>(complex_.lines.size()) + side;
  }

  /// The name of the upright plane over an edge: that of its line, or where creases moved its own.
  std::int64_t upright(std::int32_t e) const {
    const CellComplex::Edge& edge = complex_.edges[static_cast<std::size_t>(e)];
    const auto off = [&](std::int32_t v) {
      return std::abs(complex_.lines[static_cast<std::size_t>(edge.line)].line.distance(vertex(v)));
    };
    return edge.line < 0 || std::max(off(edge.v0), off(edge.v1)) <= kPlanSnap_m
               ? carrier(e)
               : static_cast<std::int64_t>(complex_.lines.size()) + 4 + e;
  }

  /// The name of a plane without its side.
  std::int64_t plane(const RunEnd& end) const {
    return end.surface < 0 ? end.level : static_cast<std::int64_t>(complex_.levels.size()) + end.surface;
  }

  /// The line in which floor and ceiling of a run meet.
  std::int64_t meeting(const Run& run) {
    const auto name = static_cast<std::int64_t>(complex_.lines.size() + 4 + meetings_.size());
    return meetings_.insert({{plane(run.lower), plane(run.upper)}, name}).first->second;
  }

  /// Floor and ceiling. Their corners: where the run is open, and beside these where it ends in an edge.
  void add_ends(std::size_t r) {
    const Run& run = columns_.runs[r];
    const auto face = static_cast<std::size_t>(run.face);
    const std::size_t n = welded_.corners(face);
    const auto first = static_cast<std::size_t>(welded_.corner_offset[face]);
    const std::int32_t* lower = &welded_.lower[static_cast<std::size_t>(welded_.knot_offset[r])];
    const std::int32_t* upper = &welded_.upper[static_cast<std::size_t>(welded_.knot_offset[r])];
    const auto open = [&](std::size_t c) { return upper[c] > lower[c]; };
    kept_.clear();
    for (std::size_t c = 0; c < n; ++c) {
      if (open(c) || (upper[c] == lower[c] && (open((c + 1) % n) || open((c + n - 1) % n)))) {
        kept_.push_back(c);
      }
    }
    if (std::none_of(kept_.begin(), kept_.end(), open)) {
      return;
    }
    carriers_.clear();
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      const std::size_t c = kept_[i];
      const std::size_t next = kept_[i + 1 < kept_.size() ? i + 1 : 0];
      carriers_.push_back(open(c) || open(next) ? carrier(welded_.corner_edge[first + c]) : meeting(run));
    }
    add_end(run, upper, SurfaceKind::kCeiling);
    measure(lower, upper);
    std::reverse(kept_.begin() + 1, kept_.end());  // a floor's normal points down, out of the empty space
    std::reverse(carriers_.begin(), carriers_.end());
    add_end(run, lower, SurfaceKind::kFloor);
  }

  void add_end(const Run& run, const std::int32_t* knots, SurfaceKind kind) {
    corners_.clear();
    for (const std::size_t c : kept_) {
      corners_.push_back(knots[c]);
    }
    const bool floor = kind == SurfaceKind::kFloor;
    out_.facets.add(corners_, carriers_, -1 - 2 * plane(floor ? run.lower : run.upper) - (floor ? 1 : 0),
                    kind, run.storey);
  }

  /// Adds the volume between the corners kept: as a fan around the first one, as volume() takes the facets.
  void measure(const std::int32_t* lower, const std::int32_t* upper) {
    const auto knot = [&](const std::int32_t* knots, std::size_t i) -> const Vec3& {
      return welded_.knots[static_cast<std::size_t>(knots[kept_[i]])];
    };
    const auto height = [&](std::size_t i) { return knot(upper, i).z() - knot(lower, i).z(); };
    double six_volumes = 0;
    for (std::size_t i = 1; i + 1 < kept_.size(); ++i) {
      const Vec3 u = knot(lower, i) - knot(lower, 0);
      const Vec3 v = knot(lower, i + 1) - knot(lower, 0);
      six_volumes += (u.x() * v.y() - u.y() * v.x()) * (height(0) + height(i) + height(i + 1));
    }
    out_.volume_m3 += six_volumes / 6;
  }

  /// For both sides of every edge, which corner of the face there begins it.
  void find_sides() {
    side_.assign(2 * complex_.edges.size(), 0);
    for (std::size_t face = 0; face < complex_.faces(); ++face) {
      const auto first = static_cast<std::size_t>(welded_.corner_offset[face]);
      for (std::size_t c = 0; c < welded_.corners(face); ++c) {
        const auto e = static_cast<std::size_t>(welded_.corner_edge[first + c]);
        if (static_cast<std::size_t>(welded_.corner_place[first + c]) < complex_.vertices.size()) {
          side_[2 * e + (complex_.edges[e].left == static_cast<std::int32_t>(face) ? 0 : 1)] = c;
        }
      }
    }
  }

  void add_walls(std::size_t e) {
    const CellComplex::Edge& edge = complex_.edges[e];
    const auto pieces =
        static_cast<std::size_t>(welded_.crossing_offset[e + 1] - welded_.crossing_offset[e]) + 1;
    for (std::size_t i = 0; i < pieces; ++i) {
      traces_.clear();
      find_beside(edge.left, side_[2 * e] + i, side_[2 * e] + i + 1, beside_[0]);
      find_beside(edge.right, side_[2 * e + 1] + pieces - i, side_[2 * e + 1] + pieces - i - 1, beside_[1]);
      std::sort(traces_.begin(), traces_.end());
      traces_.erase(std::unique(traces_.begin(), traces_.end()), traces_.end());
      for (std::size_t t = 0; t + 1 < traces_.size(); ++t) {
        add_wall(e, traces_[t], traces_[t + 1]);
      }
    }
  }

  /// The runs of a face over the part of its border between two corners, of which `to` lies further along the
  /// edge.
  void find_beside(std::int32_t face, std::size_t from, std::size_t to, std::vector<Beside>& beside) {
    beside.clear();
    if (face < 0) {
      return;
    }
    const std::size_t n = welded_.corners(static_cast<std::size_t>(face));
    for (std::size_t r = columns_.first(static_cast<std::size_t>(face));
         r < columns_.last(static_cast<std::size_t>(face)); ++r) {
      const auto knots = static_cast<std::size_t>(welded_.knot_offset[r]);
      const Trace low(welded_.lower[knots + from % n], welded_.lower[knots + to % n]);
      const Trace high(welded_.upper[knots + from % n], welded_.upper[knots + to % n]);
      if (low != high && is_below(low, high)) {
        beside.push_back({low, high, columns_.runs[r].storey});
        traces_.insert(traces_.end(), {low, high});
      }
    }
  }

  static const Beside* covering(const std::vector<Beside>& beside, const Trace& low, const Trace& high) {
    const auto found = std::find_if(beside.begin(), beside.end(), [&](const Beside& run) {
      return is_below(run.low, low) && is_below(high, run.high);
    });
    return found == beside.end() ? nullptr : &*found;
  }

  void add_wall(std::size_t e, const Trace& low, const Trace& high) {
    const Beside* left = covering(beside_[0], low, high);
    const Beside* right = covering(beside_[1], low, high);
    if ((left == nullptr) == (right == nullptr)) {
      return;
    }
    const CellComplex::Edge& edge = complex_.edges[e];
    const std::int64_t line = carrier(static_cast<std::int32_t>(e));
    bool positive =
        true;  // the normal points to the right of the way along the wall with the run on the left
    if (edge.line >= 0) {
      const Vec2 along = vertex(edge.v1) - vertex(edge.v0);
      positive = (complex_.lines[static_cast<std::size_t>(edge.line)].line.direction().dot(along) > 0) ==
                 (left != nullptr);
    }
    corners_ = {low.first};
    carriers_.clear();
    add_side(low.second, line);
    for (std::int32_t knot = low.second + 1; knot <= high.second; ++knot) {
      add_side(knot, kVertical);
    }
    for (std::int32_t knot = high.first; knot > low.first; --knot) {
      add_side(knot, knot == high.first ? line : kVertical);
    }
    carriers_.push_back(high.first > low.first ? kVertical : line);
    if (left == nullptr) {  // seen from the other side
      std::reverse(corners_.begin() + 1, corners_.end());
      std::reverse(carriers_.begin(), carriers_.end());
    }
    out_.facets.add(corners_, carriers_, 2 * upright(static_cast<std::int32_t>(e)) + (positive ? 1 : 0),
                    SurfaceKind::kWall, left != nullptr ? left->storey : right->storey);
  }

  void add_side(std::int32_t to, std::int64_t carrier) {
    corners_.push_back(to);
    carriers_.push_back(carrier);
  }

  const EndHeights& heights_;
  const CellComplex& complex_;
  const Columns& columns_;
  const WeldedColumns& welded_;
  ColumnSurface out_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> meetings_;
  std::vector<std::size_t> side_;
  std::vector<std::size_t> kept_;
  std::vector<Trace> traces_;
  std::array<std::vector<Beside>, 2> beside_;
  std::vector<std::int32_t> corners_;
  std::vector<std::int64_t> carriers_;
};

}  // namespace

ColumnSurface surface_of_columns(const EndHeights& heights, const Columns& columns,
                                 const WeldedColumns& welded) {
  return SurfaceMaker(heights, columns, welded).make();
}

}  // namespace roomcut::extract
