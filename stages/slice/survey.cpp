// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/survey.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "stages/slice/cell_table.h"

namespace roomcut {
namespace {

constexpr double kAreaUnit = 0x1.0p-30;    // m^2
constexpr double kMomentUnit = 0x1.0p-42;  // m^3
constexpr double kPatchBin = 0.01;  // m; the mean of a patch is exact, its bin only keeps surfaces apart

struct PatchSum {
  std::int64_t count = 0, area = 0, moment = 0;
  PatchSum& operator+=(const PatchSum& other) {
    count += other.count;
    area += other.area;
    moment += other.moment;
    return *this;
  }
};

struct Profile {
  std::vector<std::int64_t> horizontal, upright;
};

std::int32_t cell_of(double coordinate, double edge) {
  return static_cast<std::int32_t>(std::floor(coordinate / edge));
}

void add_patch(CellTable<PatchSum>& table, const CloudTile& tile, std::size_t i, double raster_m) {
  const CellKey key{cell_of(tile.x[i], raster_m), cell_of(tile.y[i], raster_m),
                    cell_of(tile.z[i], kPatchBin)};
  const double above_bin = tile.z[i] - key.iz * kPatchBin;
  table.at(key) += {1, std::llround(tile.area[i] / kAreaUnit),
                    std::llround(above_bin * static_cast<double>(tile.area[i]) / kMomentUnit)};
}

VerticalHistogram histogram(double z0, double bin_m, const tbb::enumerable_thread_specific<Profile>& profiles,
                            std::vector<std::int64_t> Profile::*field, std::size_t bins) {
  std::vector<std::int64_t> sums(bins, 0);
  for (const Profile& profile : profiles) {
    for (std::size_t i = 0; i < bins; ++i) sums[i] += (profile.*field)[i];
  }
  VerticalHistogram result{z0, bin_m, std::vector<double>(bins)};
  std::transform(sums.begin(), sums.end(), result.area_m2.begin(),
                 [](std::int64_t sum) { return static_cast<double>(sum) * kAreaUnit; });
  return result;
}

std::vector<SurfacePatch> to_patches(std::vector<std::vector<CellEntry<PatchSum>>> parts) {
  const std::vector<CellEntry<PatchSum>> entries = merged(std::move(parts), by_column);
  std::vector<SurfacePatch> patches;
  patches.reserve(entries.size());
  for (const auto& [key, sum] : entries) {
    if (sum.area == 0) continue;
    const double area = static_cast<double>(sum.area) * kAreaUnit;
    const double z = key.iz * kPatchBin + static_cast<double>(sum.moment) * kMomentUnit / area;
    patches.push_back({key.ix, key.iy, static_cast<std::int32_t>(sum.count), z, area});
  }
  return patches;
}

}  // namespace

HeightSurvey survey_heights(const CloudHeader& header, const TileSource& tiles, double raster_m,
                            double bin_m) {
  // One empty bin at both ends, so that no peak lies on the border.
  const double z0 = (std::floor(header.bbox_min.z() / bin_m) - 1) * bin_m;
  const auto bins = static_cast<std::size_t>(std::floor((header.bbox_max.z() - z0) / bin_m)) + 2;
  tbb::enumerable_thread_specific<Profile> profiles([bins] {
    return Profile{std::vector<std::int64_t>(bins, 0), std::vector<std::int64_t>(bins, 0)};
  });
  tbb::enumerable_thread_specific<CellTable<PatchSum>> tables;
  std::vector<std::vector<CellEntry<PatchSum>>> parts;
  std::mutex parts_mutex;

  tiles([&](std::size_t, const CloudTile& tile) {
    Profile& profile = profiles.local();
    CellTable<PatchSum>& table = tables.local();
    for (std::size_t i = 0; i < tile.size(); ++i) {
      const auto surface = static_cast<SurfaceClass>(tile.surface[i]);
      if (surface == SurfaceClass::kNone) continue;
      const double position = (tile.z[i] - z0) / bin_m;
      const auto bin = static_cast<std::size_t>(std::clamp(position, 0.0, static_cast<double>(bins - 1)));
      const bool level = surface == SurfaceClass::kHorizontal;
      (level ? profile.horizontal : profile.upright)[bin] += std::llround(tile.area[i] / kAreaUnit);
      if (level) add_patch(table, tile, i, raster_m);
    }
    std::vector<CellEntry<PatchSum>> part = table.take();
    const std::lock_guard lock(parts_mutex);
    parts.push_back(std::move(part));
  });

  HeightSurvey survey;
  survey.raster_m = raster_m;
  survey.patches = to_patches(std::move(parts));
  survey.horizontal = histogram(z0, bin_m, profiles, &Profile::horizontal, bins);
  survey.upright = histogram(z0, bin_m, profiles, &Profile::upright, bins);
  return survey;
}

}  // namespace roomcut
