// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/tree_splitter.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace roomcut {

namespace {

constexpr int kDeepest = 64;  // splits by the heuristic; then halves: at most 31 more

double half_area(const Eigen::AlignedBox3d& box) {
  const Vec3 s = box.isEmpty() ? Vec3(0, 0, 0) : Vec3(box.sizes());
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

}  // namespace

TreeSplitter::TreeSplitter(const TriangleMesh& mesh, std::vector<std::int32_t>& order)
    : order_(order), boxes_(mesh.triangles.size()), centres_(mesh.triangles.size()) {
  for (const std::int32_t t : order) {
    const auto i = static_cast<std::size_t>(t);
    boxes_[i] = Box(mesh.corner(i, 0));
    boxes_[i].extend(mesh.corner(i, 1)).extend(mesh.corner(i, 2));
    centres_[i] = boxes_[i].center();
  }
}

TreeSplitter::Box TreeSplitter::box_of(std::int32_t first, std::int32_t last) const {
  constexpr double kSlack = 1e-9;  // [m]
  Box box;
  for (std::int32_t i = first; i < last; ++i) {
    box.extend(boxes_[triangle(i)]);
  }
  return {Vec3(box.min().array() - kSlack), Vec3(box.max().array() + kSlack)};
}

std::int32_t TreeSplitter::split(std::int32_t first, std::int32_t last, int depth) {
  Box centres;
  for (std::int32_t i = first; i < last; ++i) {
    centres.extend(centres_[triangle(i)]);
  }
  int axis = 0;
  const double width = centres.sizes().maxCoeff(&axis);
  if (!(width > 0) || depth >= kDeepest) {
    return halve(first, last, axis);
  }
  const auto bin_of = [&, low = centres.min()[axis]](std::int32_t t) {
    return std::min(kBins - 1, static_cast<int>(kBins * (centre(t, axis) - low) / width));
  };
  std::array<Box, kBins> box;
  Counts count{};
  for (std::int32_t i = first; i < last; ++i) {
    const auto bin = static_cast<std::size_t>(bin_of(order_[static_cast<std::size_t>(i)]));
    box[bin].extend(boxes_[triangle(i)]);
    ++count[bin];
  }
  const int best = cheapest_split(box, count);
  const auto middle = std::partition(order_.begin() + first, order_.begin() + last,
                                     [&](std::int32_t t) { return bin_of(t) < best; });
  return static_cast<std::int32_t>(middle - order_.begin());
}

std::int32_t TreeSplitter::halve(std::int32_t first, std::int32_t last, int axis) {
  const auto begin = order_.begin();
  const std::int32_t middle = (first + last) / 2;
  std::nth_element(begin + first, begin + middle, begin + last, [&](std::int32_t a, std::int32_t b) {
    return std::pair(centre(a, axis), a) < std::pair(centre(b, axis), b);
  });
  return middle;
}

/// The first bin of the second part. The first bin and the last hold something.
int TreeSplitter::cheapest_split(const std::array<Box, kBins>& box, const Counts& count) {
  std::array<double, kBins> right_cost{};
  Box right;
  std::int32_t right_count = 0;
  for (int split = kBins - 1; split > 0; --split) {
    right.extend(box[static_cast<std::size_t>(split)]);
    right_count += count[static_cast<std::size_t>(split)];
    right_cost[static_cast<std::size_t>(split)] = half_area(right) * right_count;
  }
  int best = 1;
  double least = std::numeric_limits<double>::infinity();
  Box left;
  std::int32_t left_count = 0;
  for (int split = 1; split < kBins; ++split) {
    left.extend(box[static_cast<std::size_t>(split - 1)]);
    left_count += count[static_cast<std::size_t>(split - 1)];
    const double cost = half_area(left) * left_count + right_cost[static_cast<std::size_t>(split)];
    if (cost < least) {
      least = cost;
      best = split;
    }
  }
  return best;
}

}  // namespace roomcut
