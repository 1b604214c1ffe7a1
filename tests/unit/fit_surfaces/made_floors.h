// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "common/cloud/cloud.h"
#include "stages/fit_surfaces/plane_fit.h"
#include "tests/unit/robust/normal.h"

namespace roomcut::testing {

inline void add_flat(CloudTile& tile, const Vec2& p, double z, SurfaceClass surface) {
  tile.x.push_back(static_cast<float>(p.x()));
  tile.y.push_back(static_cast<float>(p.y()));
  tile.z.push_back(static_cast<float>(z));
  tile.surface.push_back(static_cast<std::uint8_t>(surface));
  tile.azimuth.push_back(0);
  tile.area.push_back(0.002F);
}

/// Points over the box from `low` to `high`, `per_m2` a square metre, at height(p) with noise.
inline void add_floor(CloudTile& tile, Normal& random, const Vec2& low, const Vec2& high, double per_m2,
                      double noise, const std::function<double(const Vec2&)>& height,
                      SurfaceClass surface = SurfaceClass::kHorizontal) {
  const auto count = static_cast<int>((high - low).prod() * per_m2);
  for (int i = 0; i < count; ++i) {
    const Vec2 p(random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y()));
    add_flat(tile, p, height(p) + random(noise), surface);
  }
}

/// Whole patches of half a metre over a floor of nx × ny of them, at height(p) with errors of `sigma`.
inline std::vector<fit_surfaces::Sample> made_samples(Normal& random, int nx, int ny, double sigma,
                                                      const std::function<double(const Vec2&)>& height) {
  std::vector<fit_surfaces::Sample> samples;
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      const Vec2 p(0.5 * x + 0.25, 0.5 * y + 0.25);
      samples.push_back({p, height(p) + random(sigma), sigma * sigma, 1});
    }
  }
  return samples;
}

}  // namespace roomcut::testing
