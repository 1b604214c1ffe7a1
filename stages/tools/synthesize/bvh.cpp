// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/bvh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace roomcut::synthesize {

namespace {

constexpr int kBins = 16;
constexpr std::int32_t kLeaf = 4;  // triangles per leaf, at most
constexpr double kNearest = 1e-6;  // [m]
constexpr int kStack = 64;

using Box = Eigen::AlignedBox3d;

double half_area(const Box& box) {
  if (box.isEmpty()) return 0;
  const Vec3 s = box.sizes();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

}  // namespace

struct Bvh::Build {
  std::vector<Box> boxes;
  std::vector<Vec3> centres;
};

Bvh::Bvh(const std::vector<SurfaceTriangle>& triangles) : triangles_(triangles), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  Build data;
  for (const SurfaceTriangle& t : triangles) {
    Box box(t.a);
    box.extend(Vec3(t.a + t.u)).extend(Vec3(t.a + t.v));
    data.boxes.push_back(box);
    data.centres.push_back(box.center());
  }
  nodes_.reserve(2 * triangles.size() + 1);
  if (!triangles.empty()) build(data, 0, static_cast<std::int32_t>(triangles.size()));
}

void Bvh::build(Build& data, std::int32_t begin, std::int32_t end) {
  Box box;
  Box centres;
  for (std::int32_t i = begin; i < end; ++i) {
    box.extend(data.boxes[order_[i]]);
    centres.extend(data.centres[order_[i]]);
  }
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  for (int k = 0; k < 3; ++k) {  // one step outwards, so that rounding to float loses nothing
    nodes_[self].lo[k] = std::nextafter(static_cast<float>(box.min()[k]), -1e30F);
    nodes_[self].hi[k] = std::nextafter(static_cast<float>(box.max()[k]), 1e30F);
  }
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const double low = centres.min()[axis];
  const double width = centres.sizes()[axis];
  const auto bin_of = [&](std::int32_t t) {
    return std::min(kBins - 1, static_cast<int>(kBins * (data.centres[t][axis] - low) / width));
  };
  if (end - begin <= kLeaf || width <= 0) {
    nodes_[self].first = begin;
    nodes_[self].count = end - begin;
    return;
  }
  std::array<Box, kBins> bin_box;
  std::array<int, kBins> bin_count{};
  for (std::int32_t i = begin; i < end; ++i) {
    bin_box[bin_of(order_[i])].extend(data.boxes[order_[i]]);
    ++bin_count[bin_of(order_[i])];
  }
  int best = 1;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int split = 1; split < kBins; ++split) {
    Box left;
    Box right;
    int n_left = 0;
    for (int b = 0; b < kBins; ++b) {
      (b < split ? left : right).extend(bin_box[b]);
      if (b < split) n_left += bin_count[b];
    }
    const double cost = half_area(left) * n_left + half_area(right) * (end - begin - n_left);
    if (n_left > 0 && n_left < end - begin && cost < best_cost) {
      best_cost = cost;
      best = split;
    }
  }
  const auto middle = std::partition(order_.begin() + begin, order_.begin() + end,
                                     [&](std::int32_t t) { return bin_of(t) < best; });
  const auto split = static_cast<std::int32_t>(middle - order_.begin());
  build(data, begin, split);
  nodes_[self].first = static_cast<std::int32_t>(nodes_.size());
  build(data, split, end);
}

Bvh::Hit Bvh::first_hit(const Vec3& origin, const Vec3& direction, double max_distance) const {
  Hit hit;
  hit.distance = max_distance;
  const Vec3 inverse(1 / direction.x(), 1 / direction.y(), 1 / direction.z());
  const auto enters = [&](const Node& node) {
    double near = 0;
    double far = hit.distance;
    for (int k = 0; k < 3; ++k) {
      const double t0 = (node.lo[k] - origin[k]) * inverse[k];
      const double t1 = (node.hi[k] - origin[k]) * inverse[k];
      near = std::max(near, std::min(t0, t1));
      far = std::min(far, std::max(t0, t1));
    }
    return near <= far;
  };
  std::array<std::int32_t, kStack> stack;
  int depth = 0;
  std::int32_t at = nodes_.empty() ? -1 : 0;
  while (at >= 0) {
    const Node& node = nodes_[at];
    if (enters(node)) {
      if (node.count == 0 && depth < kStack) {
        stack[depth++] = node.first;
        ++at;
        continue;
      }
      for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
        const SurfaceTriangle& t = triangles_[order_[i]];
        const Vec3 p = direction.cross(t.v);
        const double det = t.u.dot(p);
        if (det == 0) continue;
        const Vec3 s = (origin - t.a) / det;
        const double a = s.dot(p);
        const Vec3 q = s.cross(t.u);
        const double b = direction.dot(q);
        const double distance = t.v.dot(q);
        if (a >= 0 && b >= 0 && a + b <= 1 && distance > kNearest && distance < hit.distance) {
          hit = {distance, order_[i]};
        }
      }
    }
    at = depth > 0 ? stack[--depth] : -1;
  }
  return hit;
}

}  // namespace roomcut::synthesize
