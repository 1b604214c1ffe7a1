// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

/// Names of the datasets of cloud.h5 (schemas/cloud.md), for its writer and its reader.
namespace roomcut::cloud_layout {

inline constexpr const char* kX = "points/x";
inline constexpr const char* kY = "points/y";
inline constexpr const char* kZ = "points/z";
inline constexpr const char* kSurface = "points/surface";
inline constexpr const char* kAzimuth = "points/azimuth";
inline constexpr const char* kArea = "points/area";
inline constexpr const char* kPoints = "points";  ///< the group of the above
/// The columns of the points in the order of their checksums.
inline constexpr std::array kColumns = {kX, kY, kZ, kSurface, kAzimuth, kArea};
inline constexpr const char* kBlockOffset = "points/block_offset";
inline constexpr const char* kChecksum = "points/checksum";
/// Points of a block, all but the last of a tile: what is read at once, about a megabyte. Every tile begins a
/// block.
inline constexpr std::uint64_t kBlock = std::uint64_t{1} << 16;

inline constexpr const char* kTileIx = "tiles/ix";
inline constexpr const char* kTileIy = "tiles/iy";
inline constexpr const char* kTileOffset = "tiles/offset";
inline constexpr const char* kTileEdge = "tiles/edge";
inline constexpr const char* kBoxMin = "cloud/bbox_min";
inline constexpr const char* kBoxMax = "cloud/bbox_max";
inline constexpr const char* kNoise = "cloud/noise";
inline constexpr const char* kDensity = "cloud/density";
inline constexpr const char* kVoxelEdge = "cloud/voxel_edge";
inline constexpr const char* kStations = "stations/xyz";

}  // namespace roomcut::cloud_layout
