// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cloud/cloud_io.h"
#include "common/geometry/level_turn.h"
#include "stages/tools/evaluate/evaluate_io.h"

namespace roomcut::evaluate {

ScannedSurface read_scanned_surface(const std::filesystem::path& path, const ComparedAxes& axes) {
  const CloudReader cloud(path);
  const Frame& frame = cloud.header().frame;
  const Eigen::Matrix3d turn = level_turn(frame.level).transpose();
  const Vec3 origin(frame.origin[0], frame.origin[1], frame.origin[2]);
  ScannedSurface out(cloud.header().density);
  CloudTile tile;
  for (std::size_t i = 0; i < cloud.tiles(); ++i) {
    cloud.read_tile(i, tile);
    for (std::size_t k = 0; k < tile.size(); ++k) {
      out.add(axes.from_file(turn * Vec3(tile.x[k], tile.y[k], tile.z[k]) + origin));
    }
  }
  return out;
}

}  // namespace roomcut::evaluate
