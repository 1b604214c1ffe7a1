// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/nearest_triangles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace roomcut {

namespace {

constexpr double kFinest_m = 0.4;  // edge of the smallest blocks; each level's is four times the last one's
constexpr std::uint32_t kMostLevels = 10;
constexpr std::size_t kFewPoints = 6;     // not worth a block of their own
constexpr std::size_t kFewTriangles = 3;  // not worth being sorted out
constexpr std::size_t kParallel = 8192;   // points of a block whose parts are shared among threads
constexpr double kRounding = 1e-9;        // of distances between coordinates up to kilometres [m]

/// A point by its place: two bits of x, y and z for every level, the coarsest first.
struct Place {
  std::uint64_t key;
  std::uint32_t point;
};

/// Spreads the digits of base 4 of `block` six bits apart.
std::uint64_t spread(std::uint64_t block, std::uint32_t levels) {
  std::uint64_t result = 0;
  for (std::uint32_t level = 0; level < levels; ++level) {
    result |= (block >> (2 * level) & 3U) << (6 * level);
  }
  return result;
}

class Descent {
 public:
  Descent(const TriangleMesh& mesh, const std::vector<Vec3>& points, double limit)
      : points_(points), limit_(limit), hits_(points.size()) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      triangles_.push_back({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)});
    }
    sort_places();
  }

  std::vector<MeshTree::Hit> run() {
    std::vector<std::int32_t> all(triangles_.size());
    std::iota(all.begin(), all.end(), 0);
    visit(0, places_.size(), levels_, all);
    return std::move(hits_);
  }

 private:
  void sort_places() {
    Vec3 low = Vec3::Constant(MeshTree::kInfinity);
    Vec3 high = -low;
    for (const Vec3& p : points_) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const double extent = (high - low).maxCoeff();
    while (levels_ < kMostLevels && std::ldexp(kFinest_m, 2 * static_cast<int>(levels_)) <= extent) {
      ++levels_;
    }
    const double most = std::ldexp(1.0, 2 * static_cast<int>(levels_)) - 1;
    places_.reserve(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      std::uint64_t key = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double block = std::min(most, (points_[i][axis] - low[axis]) / kFinest_m);
        key |= spread(static_cast<std::uint64_t>(block), levels_) << (2 * axis);
      }
      places_.push_back({key, static_cast<std::uint32_t>(i)});
    }
    sort_by_key();
  }

  /// Digit by digit from the last, stable: places of one key stay in the order of their points.
  void sort_by_key() {
    constexpr std::uint32_t kBits = 9;
    constexpr std::size_t kDigits = std::size_t{1} << kBits;
    std::vector<Place> sorted(places_.size());
    for (std::uint32_t shift = 0; shift < 6 * levels_; shift += kBits) {
      std::array<std::size_t, kDigits> next{};
      const auto digit = [&](const Place& place) { return place.key >> shift & (kDigits - 1); };
      for (const Place& place : places_) {
        ++next[digit(place)];
      }
      std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t{0});
      for (const Place& place : places_) {
        sorted[next[digit(place)]++] = place;
      }
      places_.swap(sorted);
    }
  }

  double distance2(const Vec3& p, std::int32_t triangle) const {
    const std::array<Vec3, 3>& corners = triangles_[static_cast<std::size_t>(triangle)];
    return squared_distance(p, corners[0], corners[1], corners[2]);
  }

  /// The places [first, last) have all but `level` levels of their keys in common, and their nearest
  /// triangles are among `candidates`, which ascend.
  void visit(std::size_t first, std::size_t last, std::uint32_t level,
             const std::vector<std::int32_t>& candidates) {
    if (candidates.size() <= kFewTriangles || last - first <= kFewPoints) {
      answer(first, last, candidates);
      return;
    }
    const std::vector<std::int32_t> kept = within_reach(first, last, candidates);
    if (level == 0 || kept.size() <= kFewTriangles) {
      answer(first, last, kept);
      return;
    }
    const std::uint32_t shift = 6 * (level - 1);
    std::vector<std::size_t> borders{first};
    for (std::size_t i = first + 1; i < last; ++i) {
      if (places_[i].key >> shift != places_[i - 1].key >> shift) {
        borders.push_back(i);
      }
    }
    borders.push_back(last);
    const auto visit_part = [&](std::size_t part) {
      visit(borders[part], borders[part + 1], level - 1, kept);
    };
    if (last - first >= kParallel) {
      tbb::parallel_for(std::size_t{0}, borders.size() - 1, visit_part);
    } else {
      for (std::size_t part = 0; part + 1 < borders.size(); ++part) {
        visit_part(part);
      }
    }
  }

  /// The candidates that may be nearest to a point of the block. No point is farther from the centre of the
  /// block than r, so if the centre has a triangle at d, the nearest one of a point is at most d + r from it,
  /// hence d + 2 r from the centre.
  std::vector<std::int32_t> within_reach(std::size_t first, std::size_t last,
                                         const std::vector<std::int32_t>& candidates) const {
    Vec3 low = points_[places_[first].point];
    Vec3 high = low;
    for (std::size_t i = first + 1; i < last; ++i) {
      low = low.cwiseMin(points_[places_[i].point]);
      high = high.cwiseMax(points_[places_[i].point]);
    }
    const Vec3 centre = 0.5 * (low + high);
    const double radius = 0.5 * (high - low).norm();
    std::vector<double> distances(candidates.size());
    std::transform(candidates.begin(), candidates.end(), distances.begin(),
                   [&](std::int32_t triangle) { return std::sqrt(distance2(centre, triangle)); });
    const double nearest = *std::min_element(distances.begin(), distances.end());
    const double reach = std::min(nearest + radius, limit_) + radius + kRounding;
    std::vector<std::int32_t> kept;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (distances[k] <= reach) {
        kept.push_back(candidates[k]);
      }
    }
    return kept;
  }

  void answer(std::size_t first, std::size_t last, const std::vector<std::int32_t>& candidates) {
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t point = places_[i].point;
      double best2 = limit_ * limit_;
      std::int32_t best = -1;
      for (const std::int32_t triangle : candidates) {
        const double here = distance2(points_[point], triangle);
        if (here < best2 || (here == best2 && best < 0)) {  // of equally near ones the first
          best2 = here;
          best = triangle;
        }
      }
      hits_[point] = best < 0 ? MeshTree::Hit{} : MeshTree::Hit{std::sqrt(best2), best};
    }
  }

  const std::vector<Vec3>& points_;
  double limit_;
  std::vector<std::array<Vec3, 3>> triangles_;
  std::uint32_t levels_ = 0;
  std::vector<Place> places_;
  std::vector<MeshTree::Hit> hits_;
};

}  // namespace

std::vector<MeshTree::Hit> nearest_triangles(const TriangleMesh& mesh, const std::vector<Vec3>& points,
                                             double limit) {
  if (points.empty() || mesh.triangles.empty()) {
    return std::vector<MeshTree::Hit>(points.size());
  }
  return Descent(mesh, points, limit).run();
}

}  // namespace roomcut
