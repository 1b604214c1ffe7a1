// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/fit_surfaces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "stages/fit_surfaces/model_choice.h"
#include "stages/fit_surfaces/regions.h"
#include "stages/fit_surfaces/split.h"

namespace roomcut::fit_surfaces {
namespace {

constexpr double kFinestNoise_m = 0.002, kCoarsestNoise_m = 0.05;
constexpr double kReach_m = 0.15;
constexpr double kReachNoise = 6;
// What must be seen of a region: this much of its area, or this much floor; far from its level, more of it.
constexpr double kSeenShare = 0.1, kSeen_m2 = 2, kFar_m = 0.05, kSeenShareFar = 0.4;
constexpr double kLarge_m2 = 2;
// A plane refitted to points of its strips is the one that slice found, or something else was.
constexpr double kPlaneShift_m = 0.1, kPlaneTurn = 0.05;
constexpr double kPlanePatches = 6;

double noise_of(const CloudHeader& cloud) {
  return std::clamp(cloud.noise_m, kFinestNoise_m, kCoarsestNoise_m);
}

FaceSamples sort_samples(const Seats& seats, const std::vector<std::size_t>& chosen,
                         const std::vector<Observation>& all, double patch_m2,
                         std::vector<std::int64_t>& points) {
  FaceSamples sorted;
  std::vector<std::size_t> face_of_seat(seats.size(), 0);
  for (std::size_t at = 0; at < chosen.size(); ++at) {
    if (chosen[at] < seats.size()) {
      face_of_seat[chosen[at]] = at;
    }
  }
  const auto is_chosen = [&](const Observation& o) { return chosen[face_of_seat[o.seat]] == o.seat; };
  sorted.first.assign(chosen.size() + 1, 0);
  points.assign(chosen.size(), 0);
  for (const Observation& o : all) {
    if (is_chosen(o)) {
      ++sorted.first[face_of_seat[o.seat] + 1];
      points[face_of_seat[o.seat]] += o.points;
    }
  }
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    sorted.first[i + 1] += sorted.first[i];
  }
  sorted.samples.resize(sorted.first.back());
  std::vector<std::size_t> next(sorted.first.begin(), sorted.first.end() - 1);
  for (const Observation& o : all) {
    if (is_chosen(o)) {
      sorted.samples[next[face_of_seat[o.seat]]++] = {o.at, seats[o.seat].height(o.at) + o.offset_m,
                                                      o.variance_m2, std::min(1.0, o.area_m2 / patch_m2)};
    }
  }
  return sorted;
}

LevelSurface as_surface(const PlaneFit& fit, double area, std::int64_t points, std::int32_t plane) {
  LevelSurface surface;
  surface.gradient = fit.gradient;
  surface.c = fit.height(Vec2(0, 0));
  surface.sigma_m = std::sqrt(fit.covariance(0, 0));
  surface.area_m2 = area;
  surface.points = points;
  surface.plane = plane;
  return surface;
}

std::vector<Vec2> corners_of(const CellComplex& complex, const Region& region) {
  std::vector<Vec2> corners;
  for (const std::size_t face : region.faces) {
    for (const Vec2& p : complex.corners(complex.face_of_level(face))) {
      corners.push_back(p);
    }
  }
  return corners;
}

/// The plane itself where its points don't tell better.
LevelSurface fit_sloped(const SlopedPlane& plane, const std::vector<Sample>& samples, const Vec2& middle,
                        double area, std::int64_t points, std::int32_t index) {
  if (patches(samples) >= kPlanePatches) {
    const PlaneFit fit = fit_tilted(samples, middle, plane.gradient);
    if (std::abs(fit.z - plane.height(middle)) < kPlaneShift_m &&
        (fit.gradient - plane.gradient).norm() < kPlaneTurn * (1 + plane.gradient.squaredNorm())) {
      return as_surface(fit, area, points, index);
    }
  }
  return {plane.gradient, plane.c, plane.rms_m, area, 0, index};
}

/// A level region's surface; none where too little was seen.
std::optional<PlaneFit> fit_region(const CellComplex& complex, const Region& region,
                                   const std::vector<Sample>& samples, double patch_m2, bool may_tilt) {
  const double area = area_of(complex, region);
  const double seen = patches(samples) * patch_m2;
  if (samples.empty() || seen < std::min(kSeenShare * area, kSeen_m2)) {
    return {};
  }
  const Vec2 middle = middle_of(complex, region);
  const PlaneFit fit = fit_surface(samples, middle, corners_of(complex, region), may_tilt);
  const double shift = std::abs(fit.z - complex.levels[static_cast<std::size_t>(region.level)]);
  if (shift > kFar_m && seen < kSeenShareFar * area) {
    return {};
  }
  return fit;
}

}  // namespace

SurfaceFitter::SurfaceFitter(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                             const CloudHeader& cloud, const FitSurfacesParams& params)
    : complex_(complex),
      params_(params),
      reach_m_(params.reach_m.value_or(std::max(kReach_m, kReachNoise * noise_of(cloud)))),
      seats_(complex, label),
      observer_(complex, seats_, params.patch_m, reach_m_, noise_of(cloud)) {}

FittedSurfaces SurfaceFitter::fit() const {
  FittedSurfaces result;
  const std::vector<Observation> observations = observer_.observations();
  const std::vector<std::size_t> chosen = choose_seats(complex_, seats_, observations);
  const double patch_m2 = params_.patch_m * params_.patch_m;
  std::vector<std::int64_t> points;
  const FaceSamples samples = sort_samples(seats_, chosen, observations, patch_m2, points);
  std::vector<Region> regions;
  for (Region& region : find_regions(complex_, seats_, chosen)) {
    std::vector<Region> parts;
    if (params_.split && region.plane < 0) {
      parts = split_by_height(complex_, samples, std::move(region));
    } else {
      parts.push_back(std::move(region));
    }
    result.split += parts.size() - 1;
    std::move(parts.begin(), parts.end(), std::back_inserter(regions));
  }
  std::vector<LevelSurface>& surfaces = result.surfaces.surfaces;
  result.surfaces.of_face.assign(chosen.size(), -1);
  std::vector<std::pair<double, double>> shifts;
  for (const Region& region : regions) {
    const std::vector<Sample> own = samples.of_all(region.faces);
    const double area = area_of(complex_, region);
    std::int64_t count = 0;
    for (const std::size_t face : region.faces) {
      count += points[face];
    }
    if (region.plane >= 0) {
      surfaces.push_back(fit_sloped(complex_.planes[static_cast<std::size_t>(region.plane)], own,
                                    middle_of(complex_, region), area, count, region.plane));
    } else {
      ++result.regions;
      const std::optional<PlaneFit> fit = fit_region(complex_, region, own, patch_m2, params_.tilt);
      if (!fit) {
        ++result.unseen;
        continue;
      }
      surfaces.push_back(as_surface(*fit, area, count, -1));
      result.tilted += fit->gradient.norm() > 0 ? 1 : 0;
      shifts.emplace_back(std::abs(fit->z - complex_.levels[static_cast<std::size_t>(region.level)]), area);
      result.largest_shift_m = std::max(result.largest_shift_m, shifts.back().first);
      if (area >= kLarge_m2) {
        result.largest_rms_m = std::max(result.largest_rms_m, fit->rms_m);
      }
    }
    for (const std::size_t face : region.faces) {
      result.surfaces.of_face[face] = static_cast<std::int32_t>(surfaces.size()) - 1;
    }
  }
  std::sort(shifts.begin(), shifts.end());
  double half = 0;
  for (const auto& [shift, area] : shifts) {
    half += 0.5 * area;
  }
  for (const auto& [shift, area] : shifts) {
    result.median_shift_m = shift;
    half -= area;
    if (half <= 0) {
      break;
    }
  }
  return result;
}

}  // namespace roomcut::fit_surfaces
