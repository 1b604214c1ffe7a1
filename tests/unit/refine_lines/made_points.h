// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "common/cloud/cloud.h"
#include "stages/refine_lines/line_faces.h"
#include "tests/unit/robust/normal.h"

namespace roomcut::testing {
using namespace roomcut::refine_lines;

inline constexpr double kDeg = std::numbers::pi / 180;

inline void add_point(CloudTile& tile, const Vec2& p, double z, double theta) {
  const double turned = normalised(theta, 0).theta;
  tile.x.push_back(static_cast<float>(p.x()));
  tile.y.push_back(static_cast<float>(p.y()));
  tile.z.push_back(static_cast<float>(z));
  tile.surface.push_back(static_cast<std::uint8_t>(SurfaceClass::kWall));
  tile.azimuth.push_back(static_cast<std::uint8_t>(turned / std::numbers::pi * kAzimuthSteps));
  tile.area.push_back(0.002F);
}

/// Points on the wall `line` between t0 and t1, z 0 … 2.5 m, `per_m2` a square metre.
inline void add_wall(CloudTile& tile, Normal& random, const Line2& line, double t0, double t1, double per_m2,
                     double noise) {
  const auto count = static_cast<int>((t1 - t0) * 2.5 * per_m2);
  for (int i = 0; i < count; ++i) {
    const Vec2 p = line.at(random.uniform(t0, t1)) + random(noise) * line.normal();
    add_point(tile, p, random.uniform(0.0, 2.5), line.theta);
  }
}

/// A line that carries surface in the one layer from t0 to t1.
inline LineFaces whole_line(const Line2& line, double t0, double t1, std::int8_t side = 1) {
  LineFaces faces;
  faces.line = line;
  faces.t0 = t0;
  faces.t1 = t1;
  faces.area_m2 = (t1 - t0) * 2.5;
  faces.layers = 1;
  faces.bins = static_cast<std::size_t>(std::round((t1 - t0) / 0.1));
  faces.bin_m = (t1 - t0) / static_cast<double>(faces.bins);
  faces.side.assign(faces.bins, side);
  return faces;
}

}  // namespace roomcut::testing
