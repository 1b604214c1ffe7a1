// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/columns.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace roomcut::evaluate {

namespace {

// Twice the area of a, b, p seen from above, computed for the ends in one order, so that the triangles on
// both sides of an edge get the same number with opposite signs.
double side(const Vec3& a, const Vec3& b, double x, double y) {
  if (std::tie(b.x(), b.y()) < std::tie(a.x(), a.y())) {
    return -side(b, a, x, y);
  }
  const double cross = (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  return cross == 0 ? 1e-300 : cross;  // on the line: left of it
}

struct CellRange {
  std::int64_t x0, x1, y0, y1;
};

}  // namespace

Columns::Columns(const TriangleMesh& mesh) : mesh_(mesh), component_(connected_components(mesh)) {
  for (const std::int32_t c : component_) {
    components_ = std::max(components_, c + 1);
  }
  const Bounds3 box = bounds(mesh);
  corner_ = box.lo.head<2>();
  const Vec2 size = box.hi.head<2>() - corner_;
  const auto triangles = static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1));
  cell_ = std::max({0.1, std::sqrt(size.x() * size.y() / triangles), std::max(size.x(), size.y()) / 2000});
  nx_ = static_cast<std::int64_t>(size.x() / cell_) + 1;
  ny_ = static_cast<std::int64_t>(size.y() / cell_) + 1;
  const auto range = [&](std::size_t t) {
    const Vec3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    const auto index = [&](double value, int axis) {
      return static_cast<std::int64_t>((value - corner_[axis]) / cell_);
    };
    return CellRange{index(std::min({a.x(), b.x(), c.x()}), 0), index(std::max({a.x(), b.x(), c.x()}), 0),
                     index(std::min({a.y(), b.y(), c.y()}), 1), index(std::max({a.y(), b.y(), c.y()}), 1)};
  };
  const auto flat = [&](std::size_t t) {  // upright triangles are never crossed
    return area_normal(mesh, t).z() != 0;
  };
  offset_.assign(static_cast<std::size_t>(nx_ * ny_) + 1, 0);
  for (const bool fill : {false, true}) {
    std::vector<std::int64_t> next = offset_;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!flat(t)) {
        continue;
      }
      const CellRange r = range(t);
      for (std::int64_t y = r.y0; y <= std::min(r.y1, ny_ - 1); ++y) {
        for (std::int64_t x = r.x0; x <= std::min(r.x1, nx_ - 1); ++x) {
          const auto cell = static_cast<std::size_t>(y * nx_ + x);
          if (fill) {
            triangle_[static_cast<std::size_t>(next[cell]++)] = static_cast<std::int32_t>(t);
          } else {
            ++offset_[cell + 1];
          }
        }
      }
    }
    if (!fill) {
      for (std::size_t i = 1; i < offset_.size(); ++i) {
        offset_[i] += offset_[i - 1];
      }
      triangle_.resize(static_cast<std::size_t>(offset_.back()));
    }
  }
}

void Columns::cross(std::int32_t triangle, double x, double y, std::vector<Crossing>& out) const {
  const auto t = static_cast<std::size_t>(triangle);
  const Vec3 &a = mesh_.corner(t, 0), &b = mesh_.corner(t, 1), &c = mesh_.corner(t, 2);
  const double ab = side(a, b, x, y);
  const double bc = side(b, c, x, y);
  const double ca = side(c, a, x, y);
  if ((ab > 0) != (bc > 0) || (bc > 0) != (ca > 0)) {
    return;
  }
  const double z = (bc * a.z() + ca * b.z() + ab * c.z()) / (ab + bc + ca);
  out.push_back({z, component_of(triangle), ab > 0 ? -1 : 1});
}

void Columns::crossings(double x, double y, std::vector<Crossing>& out) const {
  out.clear();
  const auto ix = static_cast<std::int64_t>(std::floor((x - corner_.x()) / cell_));
  const auto iy = static_cast<std::int64_t>(std::floor((y - corner_.y()) / cell_));
  if (ix < 0 || iy < 0 || ix >= nx_ || iy >= ny_) {
    return;
  }
  const auto cell = static_cast<std::size_t>(iy * nx_ + ix);
  for (auto i = offset_[cell]; i < offset_[cell + 1]; ++i) {
    cross(triangle_[static_cast<std::size_t>(i)], x, y, out);
  }
  std::sort(out.begin(), out.end(), [](const Crossing& p, const Crossing& q) {
    return std::tie(p.z, p.component, p.step) < std::tie(q.z, q.component, q.step);
  });
}

bool Columns::inside(const Vec3& p) const {
  std::vector<Crossing> column;
  crossings(p.x(), p.y(), column);
  std::int32_t depth = 0;
  for (const Crossing& crossing : column) {
    depth += crossing.z < p.z() ? crossing.step : 0;
  }
  return depth > 0;
}

std::int32_t Columns::component_at(const Vec3& p) const {
  std::vector<Crossing> column;
  crossings(p.x(), p.y(), column);
  std::vector<std::int32_t> depth(static_cast<std::size_t>(components_), 0);
  for (const Crossing& crossing : column) {
    depth[static_cast<std::size_t>(crossing.component)] += crossing.z < p.z() ? crossing.step : 0;
  }
  const auto found = std::find_if(depth.begin(), depth.end(), [](std::int32_t d) { return d > 0; });
  return found == depth.end() ? -1 : static_cast<std::int32_t>(found - depth.begin());
}

void enclosed(const std::vector<Crossing>& crossings, std::int32_t component, std::vector<Interval>& out) {
  out.clear();
  std::int32_t depth = 0;
  for (const Crossing& crossing : crossings) {
    if (component >= 0 && crossing.component != component) {
      continue;
    }
    const std::int32_t before = depth;
    depth += crossing.step;
    if (before <= 0 && depth > 0) {
      out.push_back({crossing.z, crossing.z});
    } else if (before > 0 && depth <= 0) {
      out.back().hi = crossing.z;
    }
  }
}

double overlap(const std::vector<Interval>& a, const std::vector<Interval>& b) {
  double sum = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    sum += std::max(0.0, std::min(a[i].hi, b[j].hi) - std::max(a[i].lo, b[j].lo));
    if (a[i].hi < b[j].hi) {
      ++i;
    } else {
      ++j;
    }
  }
  return sum;
}

double total_length(const std::vector<Interval>& intervals) {
  double sum = 0;
  for (const Interval& i : intervals) {
    sum += i.length();
  }
  return sum;
}

void clip(const std::vector<Interval>& parts, double lo, double hi, std::vector<Interval>& out) {
  out.clear();
  for (const Interval& part : parts) {
    const Interval cut{std::max(part.lo, lo), std::min(part.hi, hi)};
    if (cut.hi > cut.lo) {
      out.push_back(cut);
    }
  }
}

void unite(std::vector<Interval>& intervals) {
  std::sort(intervals.begin(), intervals.end(),
            [](const Interval& a, const Interval& b) { return std::tie(a.lo, a.hi) < std::tie(b.lo, b.hi); });
  std::size_t kept = 0;
  for (const Interval& next : intervals) {
    if (kept > 0 && next.lo <= intervals[kept - 1].hi) {
      intervals[kept - 1].hi = std::max(intervals[kept - 1].hi, next.hi);
    } else {
      intervals[kept++] = next;
    }
  }
  intervals.resize(kept);
}

void subtract(const std::vector<Interval>& from, const std::vector<Interval>& what,
              std::vector<Interval>& out) {
  out.clear();
  std::size_t first = 0;
  for (const Interval& part : from) {
    while (first < what.size() && what[first].hi <= part.lo) {
      ++first;
    }
    double lo = part.lo;
    for (std::size_t i = first; i < what.size() && what[i].lo < part.hi; ++i) {
      if (what[i].lo > lo) {
        out.push_back({lo, what[i].lo});
      }
      lo = std::max(lo, what[i].hi);
    }
    if (part.hi > lo) {
      out.push_back({lo, part.hi});
    }
  }
}

}  // namespace roomcut::evaluate
