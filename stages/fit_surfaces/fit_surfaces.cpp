// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/fit_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "stages/fit_surfaces/model_choice.h"
#include "stages/fit_surfaces/pool.h"
#include "stages/fit_surfaces/regions.h"
#include "stages/fit_surfaces/roughness.h"
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

/// A region with what was seen of it and, where that is enough, its surface.
struct FittedRegion {
  Region region;
  std::vector<Sample> samples;
  Vec2 middle{0, 0};
  double area = 0;
  std::int64_t points = 0;
  Fits fits;  ///< of a level one with samples
  std::optional<PlaneFit> fit;
};

/// The plane itself where its points don't tell better.
LevelSurface fit_sloped(const SlopedPlane& plane, bool held, const FittedRegion& of,
                        const Roughness& roughness) {
  if (!held && patches(of.samples) >= kPlanePatches) {
    PlaneFit fit = fit_tilted(of.samples, of.middle, plane.gradient);
    measure_covariance(of.samples, roughness, fit);
    if (std::abs(fit.z - plane.height(of.middle)) < kPlaneShift_m &&
        (fit.gradient - plane.gradient).norm() < kPlaneTurn * (1 + plane.gradient.squaredNorm())) {
      return as_surface(fit, of.area, of.points, of.region.plane);
    }
  }
  return {plane.gradient, plane.c, plane.rms_m, of.area, 0, of.region.plane};
}

double level_of(const CellComplex& complex, const FittedRegion& of) {
  return complex.levels[static_cast<std::size_t>(of.region.level)];
}

/// A level region's surface; none where too little was seen.
std::optional<PlaneFit> fit_region(const CellComplex& complex, const FittedRegion& of,
                                   const Roughness& roughness, double patch_m2, bool may_tilt) {
  const double seen = patches(of.samples) * patch_m2;
  if (of.samples.empty() || seen < std::min(kSeenShare * of.area, kSeen_m2)) {
    return {};
  }
  const PlaneFit fit =
      choose_surface(of.samples, of.fits, corners_of(complex, of.region), roughness, may_tilt);
  if (std::abs(fit.z - level_of(complex, of)) > kFar_m && seen < kSeenShareFar * of.area) {
    return {};
  }
  return fit;
}

Roughness roughness_of(const std::vector<FittedRegion>& regions, double patch_m) {
  std::vector<RoughRegion> rough;
  for (const FittedRegion& of : regions) {
    if (of.region.plane < 0 && !of.samples.empty()) {
      rough.push_back({of.samples, &of.fits});
    }
  }
  return measure_roughness(rough, patch_m);
}

/// Level floors and ceilings of one level and side share what they have in common.
void pool_regions(std::vector<FittedRegion>& regions) {
  std::map<std::pair<std::int32_t, bool>, std::vector<PlaneFit*>> alike;
  for (FittedRegion& of : regions) {
    if (of.fit && of.fit->gradient == Vec2(0, 0)) {
      alike[{of.region.level, of.region.ceiling}].push_back(&*of.fit);
    }
  }
  for (const auto& [key, fits] : alike) {
    std::vector<PooledHeight> heights;
    for (const PlaneFit* fit : fits) {
      heights.push_back({fit->z, std::sqrt(fit->covariance(0, 0))});
    }
    pool_heights(heights);
    for (std::size_t i = 0; i < fits.size(); ++i) {
      fits[i]->z = heights[i].z;
      fits[i]->covariance(0, 0) = heights[i].sigma * heights[i].sigma;
    }
  }
}

/// Median of values by their weights; 0 = there are none.
double weighted_median(std::vector<std::pair<double, double>> values) {
  std::sort(values.begin(), values.end());
  double half = 0;
  for (const auto& [value, weight] : values) {
    half += 0.5 * weight;
  }
  for (const auto& [value, weight] : values) {
    half -= weight;
    if (half <= 0) {
      return value;
    }
  }
  return 0;
}

/// Counts what became of level regions.
void summarise(const CellComplex& complex, const std::vector<FittedRegion>& regions, FittedSurfaces& result) {
  std::vector<std::pair<double, double>> shifts;
  for (const FittedRegion& of : regions) {
    if (of.region.plane >= 0) {
      continue;
    }
    ++result.regions;
    if (!of.fit) {
      ++result.unseen;
      continue;
    }
    result.tilted += of.fit->gradient.norm() > 0 ? 1 : 0;
    shifts.emplace_back(std::abs(of.fit->z - level_of(complex, of)), of.area);
    result.largest_shift_m = std::max(result.largest_shift_m, shifts.back().first);
    if (of.area >= kLarge_m2) {
      result.largest_rms_m = std::max(result.largest_rms_m, of.fit->rms_m);
    }
  }
  result.median_shift_m = weighted_median(std::move(shifts));
}

}  // namespace

SurfaceFitter::SurfaceFitter(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                             const CloudHeader& cloud, const FitSurfacesParams& params)
    : complex_(complex),
      params_(params),
      reach_m_(params.reach_m.value_or(std::max(kReach_m, kReachNoise * noise_of(cloud)))),
      seats_(complex, label),
      observer_(complex, seats_, params.patch_m, reach_m_, noise_of(cloud)) {}

FittedSurfaces SurfaceFitter::fit(const std::vector<std::uint8_t>& held) const {
  FittedSurfaces result;
  const std::vector<Observation> observations = observer_.observations();
  const std::vector<std::size_t> chosen = choose_seats(complex_, seats_, observations);
  const double patch_m2 = params_.patch_m * params_.patch_m;
  std::vector<std::int64_t> points;
  const FaceSamples samples = sort_samples(seats_, chosen, observations, patch_m2, points);
  std::vector<FittedRegion> regions;
  for (Region& region : find_regions(complex_, seats_, chosen)) {
    std::vector<Region> parts;
    if (params_.split && region.plane < 0) {
      parts = split_by_height(complex_, samples, std::move(region));
    } else {
      parts.push_back(std::move(region));
    }
    result.split += parts.size() - 1;
    for (Region& part : parts) {
      FittedRegion of;
      of.region = std::move(part);
      of.samples = samples.of_all(of.region.faces);
      of.middle = middle_of(complex_, of.region);
      if (of.region.plane < 0 && !of.samples.empty()) {
        of.fits = fit_both(of.samples, of.middle);
      }
      of.area = area_of(complex_, of.region);
      for (const std::size_t face : of.region.faces) {
        of.points += points[face];
      }
      regions.push_back(std::move(of));
    }
  }
  result.roughness = roughness_of(regions, params_.patch_m);
  for (FittedRegion& of : regions) {
    if (of.region.plane < 0) {
      of.fit = fit_region(complex_, of, result.roughness, patch_m2, params_.tilt);
    }
  }
  pool_regions(regions);
  summarise(complex_, regions, result);
  std::vector<LevelSurface>& surfaces = result.surfaces.surfaces;
  result.surfaces.of_face.assign(chosen.size(), -1);
  for (const FittedRegion& of : regions) {
    if (of.region.plane >= 0) {
      const auto plane = static_cast<std::size_t>(of.region.plane);
      const bool stays = plane < held.size() && held[plane] != 0;
      surfaces.push_back(fit_sloped(complex_.planes[plane], stays, of, result.roughness));
    } else if (of.fit) {
      surfaces.push_back(as_surface(*of.fit, of.area, of.points, -1));
    } else {
      continue;
    }
    for (const std::size_t face : of.region.faces) {
      result.surfaces.of_face[face] = static_cast<std::int32_t>(surfaces.size()) - 1;
    }
  }
  return result;
}

}  // namespace roomcut::fit_surfaces
