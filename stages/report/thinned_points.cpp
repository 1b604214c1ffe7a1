// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/report/thinned_points.h"

#include <algorithm>

#include "common/cloud/cloud_io.h"
#include "common/mesh/mesh_io.h"

namespace roomcut {

std::vector<ThinPoint> thinned_points(const StageRun& run, std::uint64_t most) {
  const CloudReader cloud(run.input("cloud"));
  const CloudHeader& header = cloud.header();
  Bounds3 shown{header.bbox_min, header.bbox_max};
  if (run.has_input("model")) {
    const Vec3 origin(header.frame.origin[0], header.frame.origin[1], header.frame.origin[2]);
    shown = bounds(read_mesh(run.input("model")));
    shown.lo -= origin + Vec3::Constant(1);
    shown.hi -= origin - Vec3::Constant(1);
  }
  const std::uint64_t step = header.points / std::max<std::uint64_t>(most, 1) + 1;
  std::vector<ThinPoint> points;
  CloudTile tile;
  for (std::size_t t = 0; t < cloud.tiles(); ++t) {
    cloud.read_tile(t, tile);
    for (std::size_t i = 0; i < tile.size(); i += step) {
      const Vec3 p(tile.x[i], tile.y[i], tile.z[i]);
      if ((p.array() >= shown.lo.array()).all() && (p.array() <= shown.hi.array()).all()) {
        points.push_back({p, tile.surface[i]});
      }
    }
  }
  return points;
}

}  // namespace roomcut
