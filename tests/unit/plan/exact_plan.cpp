// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/plan/exact_plan.h"

#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace roomcut::test {

namespace {

using Kernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
using Number = Kernel::FT;
using Point = Kernel::Point_2;
using Vector = Kernel::Vector_2;
using Segment = Kernel::Segment_2;
using Arrangement = CGAL::Arrangement_2<CGAL::Arr_segment_traits_2<Kernel>>;
using Interval = std::pair<Number, Number>;

constexpr double kTouches = 1e-9;  // [m]

Point exact(const Vec2& p) {
  return {p.x(), p.y()};
}

Vec2 rounded(const Point& p) {
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y())};
}

Number cross(const Vector& a, const Vector& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The part of the line p + t u that lies on the segment: a point or, along it, more. None beside it.
std::optional<Interval> common_part(const Point& p, const Vector& u, const Segment& s) {
  const Vector v = s.target() - s.source();
  const Vector w = s.source() - p;
  const Number det = cross(u, v);
  if (det != 0) {
    const Number at = cross(w, u) / det;
    const Number t = cross(w, v) / det;
    return at >= 0 && at <= 1 ? std::optional<Interval>({t, t}) : std::nullopt;
  }
  if (cross(w, u) != 0) return std::nullopt;
  const Number a = w * u / u.squared_length();
  const Number b = (s.target() - p) * u / u.squared_length();
  return Interval{std::min(a, b), std::max(a, b)};
}

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double t = std::clamp(along.dot(p - a) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm();
}

class Cutter {
 public:
  explicit Cutter(const Vec2& high) {
    const std::array<Point, 4> corner{Point(0, 0), Point(high.x(), 0), Point(high.x(), high.y()),
                                      Point(0, high.y())};
    for (std::size_t i = 0; i < 4; ++i) add({corner[i], corner[(i + 1) % 4]});
  }

  void cut(const Ends& ends) {
    const Point p = exact(ends[0]);
    const Vector u = exact(ends[1]) - p;
    std::vector<Interval> parts;
    for (const Segment& s : segments_) {
      if (const auto part = common_part(p, u, s)) parts.push_back(*part);
    }
    std::sort(parts.begin(), parts.end());
    note_ends(parts, (ends[1] - ends[0]).norm());
    // The line runs inside the rectangle between its first part and its last.
    Number low = std::max(Number(0), parts.front().first);
    Number high = std::min(Number(1), parts.back().second);
    if (low >= high) return;
    low = end(parts, low, high);
    for (Interval& part : parts) part = {-part.second, -part.first};
    std::sort(parts.begin(), parts.end());
    high = -end(parts, -high, -low);
    if (low < high) add({p + low * u, p + high * u});
  }

  PlanCounts counts() {
    PlanCounts result{arrangement_.number_of_vertices(),
                      arrangement_.number_of_edges(),
                      arrangement_.number_of_faces() - 1,
                      {},
                      margin_};
    for (auto face = arrangement_.faces_begin(); face != arrangement_.faces_end(); ++face) {
      if (face->is_unbounded()) continue;
      Number twice = 0;
      auto edge = face->outer_ccb();
      do {
        twice += cross(edge->source()->point() - CGAL::ORIGIN, edge->target()->point() - CGAL::ORIGIN);
      } while (++edge != face->outer_ccb());
      result.areas.push_back(0.5 * CGAL::to_double(twice));
    }
    std::sort(result.areas.begin(), result.areas.end());
    for (auto vertex = arrangement_.vertices_begin(); vertex != arrangement_.vertices_end(); ++vertex) {
      const Vec2 q = rounded(vertex->point());
      for (const auto& [a, b] : rounded_) note(result.margin, distance(q, a, b));
      for (auto other = arrangement_.vertices_begin(); other != vertex; ++other) {
        note(result.margin, (q - rounded(other->point())).norm());
      }
    }
    return result;
  }

 private:
  static void note(double& margin, double off) {
    if (off > kTouches) margin = std::min(margin, off);
  }

  /// Where the cut begins: at the next edge before `low`; after the edge on which it lies.
  static Number end(const std::vector<Interval>& parts, Number low, const Number& high) {
    Number before = parts.front().first;
    for (const auto& [first, last] : parts) {
      if (first > low) break;
      if (last > low) low = before = last;  // along an edge, until it ends
      before = std::max(before, std::min(last, low));
    }
    return low < high ? before : high;
  }

  void note_ends(const std::vector<Interval>& parts, double length) {
    for (const auto& [first, last] : parts) {
      for (const Number& t : {first, last}) {
        note(margin_, length * std::abs(CGAL::to_double(t)));
        note(margin_, length * std::abs(CGAL::to_double(t - 1)));
      }
    }
  }

  void add(const Segment& s) {
    segments_.push_back(s);
    rounded_.push_back({rounded(s.source()), rounded(s.target())});
    CGAL::insert(arrangement_, s);
  }

  Arrangement arrangement_;
  std::vector<Segment> segments_;
  std::vector<Ends> rounded_;
  double margin_ = 1e9;
};

}  // namespace

PlanCounts exact_plan(const Vec2& high, const std::vector<Ends>& segments) {
  Cutter cutter(high);
  for (const Ends& ends : segments) cutter.cut(ends);
  return cutter.counts();
}

}  // namespace roomcut::test
