// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/mesh_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "common/mesh/tree_splitter.h"

namespace roomcut {

namespace {

constexpr std::int32_t kLeafSize = 2;
constexpr double kRounding = 1e-10;  // of coordinates up to a kilometre, generously [m]
constexpr std::size_t kStack = 128;  // deeper than any tree of a TreeSplitter

Vec3 cross(const Vec3& u, const Vec3& v) {
  return {u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(), u.x() * v.y() - u.y() * v.x()};
}

// Where the ray meets the triangle, as a distance from its start; -1 = nowhere (Möller and Trumbore 1997).
double distance_along(const Vec3& from, const Vec3& unit, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 h = cross(unit, ac);
  const double det = ab.dot(h);
  if (det == 0) {
    return -1;
  }
  const Vec3 s = (from - a) / det;
  const double u = s.dot(h);
  if (u < 0 || u > 1) {
    return -1;
  }
  const Vec3 q = cross(s, ab);
  const double v = unit.dot(q);
  return v < 0 || u + v > 1 ? -1 : ac.dot(q);
}

// A ray against boxes.
class BoxRay {
 public:
  BoxRay(const Vec3& from, const Vec3& unit) : from_(from) {
    constexpr double kLevel = 1e-300;  // instead of 0, whose inverse times 0 is no number
    for (int axis = 0; axis < 3; ++axis) {
      inverse_[axis] = 1 / (unit[axis] == 0 ? kLevel : unit[axis]);
    }
  }

  // Where it enters the box; infinite when it does not, or not within `farthest`.
  double entry(const Vec3& lo, const Vec3& hi, double farthest) const {
    double enter = 0;
    double leave = farthest;
    for (int axis = 0; axis < 3; ++axis) {
      const double t0 = (lo[axis] - from_[axis]) * inverse_[axis];
      const double t1 = (hi[axis] - from_[axis]) * inverse_[axis];
      enter = std::max(enter, std::min(t0, t1));
      leave = std::min(leave, std::max(t0, t1));
    }
    return enter <= leave ? enter : MeshTree::kInfinity;
  }

 private:
  Vec3 from_, inverse_;
};

double box_distance2(const Vec3& p, const Vec3& lo, const Vec3& hi) {
  return (lo - p).cwiseMax(p - hi).cwiseMax(0.0).squaredNorm();
}

}  // namespace

// The region of the triangle's plane in which the foot of p lies decides between corner, side and inside
// (Ericson 2005, Real-Time Collision Detection, 5.1.5).
double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return ap.squaredNorm();
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return bp.squaredNorm();
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return cp.squaredNorm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - d1 / (d1 - d3) * ab).squaredNorm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).squaredNorm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6)
    return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).squaredNorm();
  const Vec3 n = cross(ab, ac);  // never zero here: one of the cases above holds for a triangle without area
  const double along = n.dot(ap);
  return along * along / n.squaredNorm();
}

MeshTree::MeshTree(const TriangleMesh& mesh) {
  std::vector<std::int32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  build(mesh, std::move(all));
}

MeshTree::MeshTree(const TriangleMesh& mesh, std::vector<std::int32_t> subset) {
  build(mesh, std::move(subset));
}

void MeshTree::build(const TriangleMesh& mesh, std::vector<std::int32_t> subset) {
  normal_.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 n = area_normal(mesh, t);
    const double length = n.norm();
    normal_.push_back(length > 0 ? Vec3(n / length) : Vec3(0, 0, 0));
  }
  item_of_.assign(mesh.triangles.size(), -1);
  if (subset.empty()) {
    return;
  }
  TreeSplitter splitter(mesh, subset);
  struct Range {
    std::size_t node;
    std::int32_t first, last;
    int depth;
  };
  nodes_.emplace_back();
  std::vector<Range> open{{0, 0, static_cast<std::int32_t>(subset.size()), 0}};
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    const Eigen::AlignedBox3d box = splitter.box_of(range.first, range.last);
    if (range.last - range.first <= kLeafSize) {
      nodes_[range.node] = {box.min(), box.max(), range.first, range.last - range.first};
      continue;
    }
    const std::int32_t middle = splitter.split(range.first, range.last, range.depth);
    const auto child = static_cast<std::int32_t>(nodes_.size());
    nodes_[range.node] = {box.min(), box.max(), child, 0};
    nodes_.resize(nodes_.size() + 2);
    open.push_back({static_cast<std::size_t>(child), range.first, middle, range.depth + 1});
    open.push_back({static_cast<std::size_t>(child) + 1, middle, range.last, range.depth + 1});
  }
  items_.reserve(subset.size());
  for (const std::int32_t t : subset) {
    const auto i = static_cast<std::size_t>(t);
    item_of_[i] = static_cast<std::int32_t>(items_.size());
    items_.push_back({mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2), t});
  }
}

template <class Accept>
MeshTree::Hit MeshTree::search(const Vec3& p, Start start, const Accept& accept) const {
  if (nodes_.empty()) {
    return {};
  }
  auto [best2, best] = start;
  // Boxes are passed over only when they are farther by more than rounding can make up: the answer is then
  // the same in whatever order the triangles are met.
  const auto reach = [](double d2) { return d2 + kRounding * (2 * std::sqrt(d2) + kRounding); };
  double reach2 = reach(best2);
  struct Entry {
    double distance2;
    std::int32_t node;
  };
  std::array<Entry, kStack> stack;
  std::size_t depth = 0;
  stack[depth++] = {box_distance2(p, nodes_[0].lo, nodes_[0].hi), 0};
  while (depth > 0) {
    const Entry entry = stack[--depth];
    if (entry.distance2 > reach2) {
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(entry.node)];
    if (node.count == 0) {
      const auto left = static_cast<std::size_t>(node.first);
      Entry near{box_distance2(p, nodes_[left].lo, nodes_[left].hi), node.first};
      Entry far{box_distance2(p, nodes_[left + 1].lo, nodes_[left + 1].hi), node.first + 1};
      if (far.distance2 < near.distance2) {
        std::swap(near, far);
      }
      if (far.distance2 <= reach2) {
        stack[depth++] = far;
      }
      if (near.distance2 <= reach2) {
        stack[depth++] = near;
      }
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const Item& item = items_[static_cast<std::size_t>(i)];
      if (!accept(item.triangle)) {
        continue;
      }
      const double distance2 = squared_distance(p, item.a, item.b, item.c);
      // Of equally near triangles the lowest wins, whatever the order of the search.
      if (distance2 < best2 || (distance2 == best2 && (best < 0 || item.triangle < best))) {
        best2 = distance2;
        best = item.triangle;
        reach2 = reach(best2);
      }
    }
  }
  return best < 0 ? Hit{} : Hit{std::sqrt(best2), best};
}

MeshTree::Hit MeshTree::nearest(const Vec3& p, double limit, std::int32_t hint) const {
  Start start{limit * limit, -1};
  if (hint >= 0 && item_of_[static_cast<std::size_t>(hint)] >= 0) {
    const Item& item = items_[static_cast<std::size_t>(item_of_[static_cast<std::size_t>(hint)])];
    const double distance2 = squared_distance(p, item.a, item.b, item.c);
    if (distance2 < start.distance2) {
      start = {distance2, hint};
    }
  }
  return search(p, start, [](std::int32_t) { return true; });
}

MeshTree::Hit MeshTree::nearest_facing(const Vec3& p, double limit, const Vec3& direction,
                                       double least_cosine) const {
  return search(p, {limit * limit, -1},
                [&](std::int32_t triangle) { return unit_normal(triangle).dot(direction) >= least_cosine; });
}

MeshTree::Hit MeshTree::first_on_ray(const Vec3& from, const Vec3& unit, double nearest,
                                     double farthest) const {
  Hit best{farthest, -1};
  const BoxRay ray(from, unit);
  struct Entry {
    double distance;
    std::int32_t node;
  };
  const auto entry = [&](std::int32_t node) {
    const Node& box = nodes_[static_cast<std::size_t>(node)];
    return Entry{ray.entry(box.lo, box.hi, best.distance), node};
  };
  std::array<Entry, kStack> stack;
  std::size_t depth = 0;
  if (!nodes_.empty()) {
    stack[depth++] = entry(0);
  }
  while (depth > 0) {
    const Entry at = stack[--depth];
    if (at.distance > best.distance) {
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(at.node)];
    if (node.count == 0) {
      Entry near = entry(node.first);
      Entry far = entry(node.first + 1);
      if (far.distance < near.distance) {
        std::swap(near, far);
      }
      if (far.distance <= best.distance) {
        stack[depth++] = far;
      }
      if (near.distance <= best.distance) {
        stack[depth++] = near;
      }
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const Item& item = items_[static_cast<std::size_t>(i)];
      const double t = distance_along(from, unit, item.a, item.b, item.c);
      if (t >= nearest && (t < best.distance ||
                           (t == best.distance && (best.triangle < 0 || item.triangle < best.triangle)))) {
        best = {t, item.triangle};
      }
    }
  }
  return best.triangle < 0 ? Hit{} : best;
}

}  // namespace roomcut
