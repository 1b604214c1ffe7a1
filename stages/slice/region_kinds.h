// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "stages/slice/regions.h"

namespace roomcut::slice {

/// What a planar region is: a part of a level; too narrow or small to say; a piece of something bent; a
/// sloped plane.
enum class RegionKind : std::uint8_t { kLevel, kScrap, kBent, kPlane };

/// Whether it slopes by 0.5 to 68 degrees and rises by more than a level tolerates: 8 cm, 12 noise, and 16
/// noise below 4 %.
bool slopes(const PlanarRegion& region, const std::vector<SurfaceVoxel>& voxels, double noise_m);

/// Wider than 0.5 m.
bool is_wide(const PlanarRegion& region);

/// The kinds of all regions. A plane holds its points within noise and 1.5 % of its rise, from 12 degrees on
/// 1 cm; else it is bent. Gentle regions (below 6 degrees) that go on smoothly into a bent one are bent, too:
/// a surface drifts as a whole. Deterministic.
std::vector<RegionKind> region_kinds(const std::vector<PlanarRegion>& regions,
                                     const std::vector<SurfaceVoxel>& voxels, const VoxelGraph& graph,
                                     double noise_m);

inline constexpr double kPlaneLeast_m2 = 2;  ///< a plane has more
inline constexpr double kSteepestPlane = 68 * std::numbers::pi / 180;
inline constexpr double kGentlestPlane = 0.5 * std::numbers::pi / 180;
/// Nothing that is meant to be level is so steep.
inline constexpr double kBuiltSlope = 12 * std::numbers::pi / 180;

}  // namespace roomcut::slice
