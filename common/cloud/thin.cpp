// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cloud/thin.h"

namespace roomcut {

namespace {

void resize(CloudTile& tile, std::size_t points) {
  for (std::vector<float>* values : {&tile.x, &tile.y, &tile.z, &tile.area}) {
    values->resize(points);
  }
  tile.surface.resize(points);
  tile.azimuth.resize(points);
}

}  // namespace

void thin(CloudTile& tile, double most) {
  const double share = 1 / most;
  const std::size_t points = tile.size();
  std::size_t kept = 0;
  double area = 0;
  for (std::size_t i = 0; i < points; ++i) {
    area += static_cast<double>(tile.area[i]);
    const bool last = i + 1 == points || tile.surface[i + 1] != tile.surface[i];
    if (area < share && !last) {
      continue;
    }
    tile.x[kept] = tile.x[i];
    tile.y[kept] = tile.y[i];
    tile.z[kept] = tile.z[i];
    tile.surface[kept] = tile.surface[i];
    tile.azimuth[kept] = tile.azimuth[i];
    tile.area[kept] = static_cast<float>(area);
    ++kept;
    area = 0;
  }
  resize(tile, kept);
}

}  // namespace roomcut
