// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cloud/thin.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace roomcut {
namespace {

/// `points` points of one class, each of `area`.
void add(CloudTile& tile, SurfaceClass surface, std::size_t points, float area) {
  for (std::size_t i = 0; i < points; ++i) {
    tile.x.push_back(static_cast<float>(tile.size()));
    tile.y.push_back(0);
    tile.z.push_back(1);
    tile.surface.push_back(static_cast<std::uint8_t>(surface));
    tile.azimuth.push_back(static_cast<std::uint8_t>(i % 256));
    tile.area.push_back(area);
  }
}

double area_of(const CloudTile& tile, SurfaceClass surface) {
  double area = 0;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    area += tile.surface[i] == static_cast<std::uint8_t>(surface) ? static_cast<double>(tile.area[i]) : 0.0;
  }
  return area;
}

std::size_t count_of(const CloudTile& tile, SurfaceClass surface) {
  return static_cast<std::size_t>(
      std::count(tile.surface.begin(), tile.surface.end(), static_cast<std::uint8_t>(surface)));
}

TEST(Thin, keeps_the_area_of_every_class_and_thins_to_the_density_asked_for) {
  CloudTile tile;
  add(tile, SurfaceClass::kHorizontal, 10'000, 1e-4F);  // 10,000 per m², 1 m²
  add(tile, SurfaceClass::kWall, 7, 1e-4F);             // less than one share in all
  add(tile, SurfaceClass::kSloped, 5'001, 3e-5F);
  thin(tile, 1000);
  EXPECT_NEAR(area_of(tile, SurfaceClass::kHorizontal), 1.0, 1e-6);
  EXPECT_NEAR(area_of(tile, SurfaceClass::kWall), 7e-4, 1e-9);
  EXPECT_NEAR(area_of(tile, SurfaceClass::kSloped), 0.15003, 1e-6);
  EXPECT_NEAR(static_cast<double>(count_of(tile, SurfaceClass::kHorizontal)), 1000, 100);
  EXPECT_EQ(count_of(tile, SurfaceClass::kWall), 1U);
  EXPECT_NEAR(static_cast<double>(count_of(tile, SurfaceClass::kSloped)), 150, 10);
  for (const std::size_t size :
       {tile.y.size(), tile.z.size(), tile.surface.size(), tile.azimuth.size(), tile.area.size()}) {
    EXPECT_EQ(size, tile.x.size());
  }
}

TEST(Thin, leaves_what_is_sparse_as_it_is) {
  CloudTile tile;
  add(tile, SurfaceClass::kHorizontal, 300, 2e-3F);
  add(tile, SurfaceClass::kNone, 50, 5e-3F);
  const CloudTile before = tile;
  thin(tile, 1000);
  EXPECT_EQ(tile.x, before.x);
  EXPECT_EQ(tile.area, before.area);
  EXPECT_EQ(tile.azimuth, before.azimuth);
}

TEST(Thin, takes_the_kept_points_evenly) {
  CloudTile tile;
  add(tile, SurfaceClass::kWall, 9'000, 1e-4F);
  thin(tile, 2000);
  for (std::size_t i = 1; i < tile.size(); ++i) {
    EXPECT_LE(tile.x[i] - tile.x[i - 1], 6.0F);
  }
}

TEST(Thin, of_nothing_is_nothing) {
  CloudTile tile;
  thin(tile, 1000);
  EXPECT_EQ(tile.size(), 0U);
}

}  // namespace
}  // namespace roomcut
