// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "common/artefact/provenance.h"
#include "common/geometry/line2.h"

namespace roomcut {

/// What the surface around a point is, from the second moments of its voxel neighbourhood.
enum class SurfaceClass : std::uint8_t {
  kNone = 0,        ///< no clear plane: edges, clutter, too few points
  kHorizontal = 1,  ///< floor, ceiling, table
  kWall = 2,        ///< upright plane; azimuth is valid
  kSloped = 3,      ///< a plane that is neither
};

inline constexpr int kAzimuthSteps = 256;  ///< azimuth byte k stands for theta = (k + 1/2) * pi / 256

inline double azimuth_of(std::uint8_t step) {
  return (step + 0.5) * std::numbers::pi / kAzimuthSteps;
}

/// The points of one tile (a column of the cloud, square in plan), structure of arrays, local metres.
/// Inside a tile the points are sorted by surface class, then by voxel; one with many points is bands of
/// rows, each sorted so.
struct CloudTile {
  std::vector<float> x, y, z;
  std::vector<std::uint8_t> surface;  ///< SurfaceClass
  std::vector<std::uint8_t> azimuth;  ///< of the wall's normal, modulo pi; 0 unless surface is kWall
  std::vector<float> area;            ///< surface area that the point stands for: 1/density [m^2]
  std::size_t size() const { return x.size(); }
};

/// What is known of the whole cloud.
struct CloudHeader {
  Frame frame;
  std::uint64_t points = 0;
  Vec3 bbox_min{0, 0, 0}, bbox_max{0, 0, 0};  ///< of the kept points, local metres
  double noise_m = 0;  ///< standard deviation of points off their plane, median over planar voxels [m]
  double density = 0;  ///< points per square metre of surface, median over points
  double tile_edge_m = 0;
  double voxel_edge_m = 0;                     ///< finest voxel of the moments
  std::vector<std::int32_t> tile_ix, tile_iy;  ///< tile i covers [ix, ix+1) × [iy, iy+1) tile edges from the
                                               ///< local origin; sorted by (iy, ix)
  std::vector<std::uint64_t> tile_offset;      ///< first point of tile i; size tiles+1
  std::vector<Vec3> stations;  ///< scanner positions, where the file names them (local metres)
};

}  // namespace roomcut
