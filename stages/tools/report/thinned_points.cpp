// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/report/thinned_points.h"

#include <algorithm>

#include "common/cloud/cloud_io.h"
#include "common/mesh/mesh_io.h"

namespace roomcut::report {

namespace {

constexpr std::uint64_t kPart = std::uint64_t{1} << 16;  // points read at once

}  // namespace

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
  points.reserve(header.points / step + cloud.tiles());
  CloudTile part;
  for (std::size_t t = 0; t < cloud.tiles(); ++t) {
    const std::uint64_t size = header.tile_offset[t + 1] - header.tile_offset[t];
    std::uint64_t next = 0;  // of the tile's points
    for (std::uint64_t first = 0; first < size; first += kPart) {
      cloud.read_part(t, first, std::min(kPart, size - first), part);
      for (; next < first + part.size(); next += step) {
        const std::size_t i = next - first;
        const Vec3 p(part.x[i], part.y[i], part.z[i]);
        if ((p.array() >= shown.lo.array()).all() && (p.array() <= shown.hi.array()).all()) {
          points.push_back({p, part.surface[i]});
        }
      }
    }
  }
  return points;
}

}  // namespace roomcut::report
