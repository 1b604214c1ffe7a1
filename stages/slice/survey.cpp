// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/survey.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>

#include "stages/slice/cell_parts.h"
#include "stages/slice/fixed_point.h"

namespace roomcut::slice {
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

struct AreaSum {
  std::int64_t area = 0, sloped = 0;
  AreaSum& operator+=(const AreaSum& other) {
    area += other.area;
    sloped += other.sloped;
    return *this;
  }
};

/// What one thread, or one tile, has summed.
struct Sums {
  std::vector<std::int64_t> histogram;
  CellTable<PatchSum> patches;
  CellTable<AreaSum> upright;
  CellTable<VoxelSum> voxels;
};

void add_patch(CellTable<PatchSum>& table, const CloudTile& tile, std::size_t i, double raster_m,
               float area_m2) {
  const CellKey key{floor_to_int(tile.x[i] / raster_m), floor_to_int(tile.y[i] / raster_m),
                    floor_to_int(tile.z[i] / kPatchBin)};
  const double above_bin = tile.z[i] - key.iz * kPatchBin;
  table.at(key) +=
      {1, to_units(area_m2, kAreaUnit), to_units(above_bin * static_cast<double>(area_m2), kMomentUnit)};
}

void add_upright(CellTable<AreaSum>& table, const CloudTile& tile, std::size_t i) {
  const CellKey key{floor_to_int(tile.x[i] / kUprightPlan), floor_to_int(tile.y[i] / kUprightPlan),
                    floor_to_int(tile.z[i] / kUprightHeight)};
  const std::int64_t area = to_units(tile.area[i], kAreaUnit);
  const bool sloped = static_cast<SurfaceClass>(tile.surface[i]) == SurfaceClass::kSloped;
  table.at(key) += {area, sloped ? area : 0};
}

VerticalHistogram histogram(double z0, double bin_m, const tbb::enumerable_thread_specific<Sums>& threads,
                            std::size_t bins) {
  std::vector<std::int64_t> sums(bins, 0);
  for (const Sums& thread : threads) {
    for (std::size_t i = 0; i < bins; ++i) sums[i] += thread.histogram[i];
  }
  VerticalHistogram result{z0, bin_m, std::vector<double>(bins)};
  std::transform(sums.begin(), sums.end(), result.area_m2.begin(),
                 [](std::int64_t sum) { return static_cast<double>(sum) * kAreaUnit; });
  return result;
}

std::vector<UprightBlock> to_blocks(const std::vector<CellEntry<AreaSum>>& entries) {
  std::vector<UprightBlock> blocks;
  blocks.reserve(entries.size());
  for (const auto& [key, sum] : entries) {
    blocks.push_back({key.ix, key.iy, key.iz, static_cast<double>(sum.area) * kAreaUnit,
                      static_cast<double>(sum.sloped) * kAreaUnit});
  }
  return blocks;
}

std::vector<SurfacePatch> to_patches(const std::vector<CellEntry<PatchSum>>& entries) {
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

HeightSurvey survey_heights(const CloudHeader& header, const TileSource& tiles, double raster_m, double bin_m,
                            bool by_area) {
  // One empty bin at both ends, so that no peak lies on the border.
  const double z0 = (std::floor(header.bbox_min.z() / bin_m) - 1) * bin_m;
  const auto bins = static_cast<std::size_t>(std::floor((header.bbox_max.z() - z0) / bin_m)) + 2;
  tbb::enumerable_thread_specific<Sums> threads([bins] {
    return Sums{std::vector<std::int64_t>(bins, 0), {}, {}, {}};
  });
  CellParts<PatchSum, decltype(by_column)> patches(by_column);
  CellParts<AreaSum, decltype(by_column)> upright(by_column);
  CellParts<VoxelSum, decltype(by_column)> voxels(by_column);
  const VoxelSize size = voxel_size(raster_m);
  const float mean_m2 = header.density > 0 ? static_cast<float>(1 / header.density) : 1.0F;

  tiles([&](std::size_t index, const CloudTile& tile) {
    Sums& sums = threads.local();
    for (std::size_t i = 0; i < tile.size(); ++i) {
      const auto surface = static_cast<SurfaceClass>(tile.surface[i]);
      if (surface == SurfaceClass::kHorizontal) {
        const double position = (tile.z[i] - z0) / bin_m;
        const auto bin = static_cast<std::size_t>(std::clamp(position, 0.0, static_cast<double>(bins - 1)));
        const float area_m2 = by_area ? tile.area[i] : mean_m2;
        sums.histogram[bin] += to_units(area_m2, kAreaUnit);
        add_patch(sums.patches, tile, i, raster_m, area_m2);
      } else if (surface != SurfaceClass::kNone) {
        add_upright(sums.upright, tile, i);
      }
      if (surface == SurfaceClass::kHorizontal || surface == SurfaceClass::kSloped) {
        add_to_voxel(sums.voxels, size, {tile.x[i], tile.y[i], tile.z[i]}, tile.area[i]);
      }
    }
    patches.add(index, sums.patches.take());
    upright.add(index, sums.upright.take());
    voxels.add(index, sums.voxels.take());
  });

  HeightSurvey survey;
  survey.raster_m = raster_m;
  survey.patches = to_patches(patches.take());
  survey.upright = to_blocks(upright.take());
  survey.voxel = size;
  survey.voxels = to_voxels(voxels.take(), size);
  survey.horizontal = histogram(z0, bin_m, threads, bins);
  return survey;
}

}  // namespace roomcut::slice
