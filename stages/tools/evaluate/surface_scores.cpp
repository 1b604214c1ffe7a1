// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/surface_scores.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace roomcut::evaluate {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kClassLimit = 0.10 + 1e-9;    // the largest buffer; what lies on its border is within
constexpr double kNearlyLevel = 20 * kDegree;  // steeper ones may be met by a surface of another class
constexpr double kFineDistance = 0.005;
constexpr double kCloseDistance = 0.02, kCloseAngle = 1 * kDegree;
constexpr double kLooseDistance = 0.04, kLooseAngle = 1.5 * kDegree;

std::vector<std::int32_t> triangles_of(const TriangleMesh& mesh, const MeshTree& tree, SlopeClass slope) {
  std::vector<std::int32_t> out;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t) {
    if (slope_class(tree.unit_normal(t)) == slope) {
      out.push_back(t);
    }
  }
  return out;
}

// The least value that `share` of the weight does not exceed.
double weighted_quantile(std::vector<std::pair<double, double>>& value_weight, double share) {
  std::sort(value_weight.begin(), value_weight.end());
  double total = 0;
  for (const auto& [value, weight] : value_weight) {
    total += weight;
  }
  double sum = 0;
  for (const auto& [value, weight] : value_weight) {
    sum += weight;
    if (sum >= share * total) {
      return value;
    }
  }
  return value_weight.empty() ? 0 : value_weight.back().first;
}

Deviation summarise(const SurfaceDistances& measured) {
  Deviation out;
  double area = 0;
  double squares = 0;
  std::vector<std::pair<double, double>> weighted;
  for (std::size_t i = 0; i < measured.samples.size(); ++i) {
    const double d = measured.distance[i];
    const double w = measured.samples[i].area_m2;
    out.max = std::max(out.max, d);
    area += w;
    out.mean += w * d;
    squares += w * d * d;
    if (w > 0) {
      weighted.emplace_back(d, w);
    }
  }
  if (area > 0) {
    out.mean /= area;
    out.rms = std::sqrt(squares / area);
  }
  out.p95 = weighted_quantile(weighted, 0.95);
  return out;
}

// Share of the area of one slope class that is within the buffer; empty without area.
std::optional<double> share_within(const SurfaceDistances& measured, SlopeClass slope, double buffer_m) {
  double area = 0;
  double within = 0;
  for (std::size_t i = 0; i < measured.samples.size(); ++i) {
    if (measured.slope[i] == slope) {
      area += measured.samples[i].area_m2;
      within += measured.class_distance[i] <= buffer_m + 1e-9 ? measured.samples[i].area_m2 : 0;
    }
  }
  return area > 0 ? std::optional(within / area) : std::nullopt;
}

/// How closely `surface` follows a place that is `nearest_m` from the nearest surface of any class.
Match match(const MeshTree& surface, const Vec3& p, const Vec3& normal, double nearest_m) {
  const auto follows = [&](double distance, double angle) {
    return nearest_m <= distance &&
           surface.nearest_facing(p, distance + 1e-9, normal, std::cos(angle)).triangle >= 0;
  };
  if (follows(kFineDistance, kCloseAngle)) {
    return Match::kFine;
  }
  if (follows(kCloseDistance, kCloseAngle)) {
    return Match::kClose;
  }
  return follows(kLooseDistance, kLooseAngle) ? Match::kLoose : Match::kNone;
}

}  // namespace

SlopeClass slope_class(const Vec3& unit_normal) {
  const double up = std::abs(unit_normal.z());
  if (up <= std::sin(10 * kDegree)) {
    return SlopeClass::kWall;
  }
  return up >= std::cos(25 * kDegree) ? SlopeClass::kHorizontal : SlopeClass::kSloped;
}

MeasuredSurface::MeasuredSurface(const TriangleMesh& mesh)
    : all_(mesh),
      classes_{MeshTree(mesh, triangles_of(mesh, all_, SlopeClass::kWall)),
               MeshTree(mesh, triangles_of(mesh, all_, SlopeClass::kHorizontal)),
               MeshTree(mesh, triangles_of(mesh, all_, SlopeClass::kSloped))} {}

SurfaceDistances measure(const TriangleMesh& from, const MeasuredSurface& from_surface,
                         const MeasuredSurface& to, double spacing_m, std::uint64_t seed,
                         const std::function<bool(const Vec3&)>& counts) {
  SurfaceDistances out;
  out.samples = sample_surface(from, spacing_m, seed);
  std::erase_if(out.samples, [&](const SurfaceSample& sample) {
    return !counts(sample.point) && to.all().nearest(sample.point, kClassLimit).triangle < 0;
  });
  const std::size_t n = out.samples.size();
  out.slope.resize(n);
  out.distance.resize(n);
  out.class_distance.resize(n);
  out.match.resize(n, Match::kNone);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, n, 512), [&](const tbb::blocked_range<std::size_t>& range) {
        std::int32_t hint = -1;  // saves time, changes nothing: samples follow each other on the surface
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const SurfaceSample& sample = out.samples[i];
          const Vec3& normal = from_surface.all().unit_normal(sample.triangle);
          out.slope[i] = slope_class(normal);
          const MeshTree::Hit hit = to.all().nearest(sample.point, MeshTree::kInfinity, hint);
          out.distance[i] = hit.distance;
          hint = hit.triangle;
          if (!(sample.area_m2 > 0)) {
            continue;
          }
          const bool same = slope_class(to.all().unit_normal(hit.triangle)) == out.slope[i];
          out.class_distance[i] =
              same ? hit.distance : to.of(out.slope[i]).nearest(sample.point, kClassLimit).distance;
          const bool steep =
              std::abs(normal.z()) < std::cos(kNearlyLevel) && out.slope[i] != SlopeClass::kWall;
          const MeshTree& candidates = steep ? to.all() : to.of(out.slope[i]);
          out.match[i] = match(candidates, sample.point, normal, hit.distance);
        }
      });
  out.deviation = summarise(out);
  return out;
}

IsprsScore isprs_score(const SurfaceDistances& truth, const SurfaceDistances& model, SlopeClass slope,
                       double buffer_m) {
  IsprsScore score;
  score.completeness = share_within(truth, slope, buffer_m);
  score.correctness = share_within(model, slope, buffer_m);
  std::vector<std::pair<double, double>> near;
  for (std::size_t i = 0; i < truth.samples.size(); ++i) {
    if (truth.slope[i] == slope && truth.samples[i].area_m2 > 0 &&
        truth.class_distance[i] <= buffer_m + 1e-9) {
      near.emplace_back(truth.class_distance[i], truth.samples[i].area_m2);
    }
  }
  if (!near.empty()) {
    score.accuracy_m = weighted_quantile(near, 0.5);
  }
  return score;
}

std::optional<double> matched_share(const SurfaceDistances& truth, SlopeClass slope, Match least) {
  double area = 0;
  double matched = 0;
  for (std::size_t i = 0; i < truth.samples.size(); ++i) {
    if (truth.slope[i] == slope) {
      area += truth.samples[i].area_m2;
      matched += truth.match[i] >= least ? truth.samples[i].area_m2 : 0;
    }
  }
  return area > 0 ? std::optional(matched / area) : std::nullopt;
}

}  // namespace roomcut::evaluate
