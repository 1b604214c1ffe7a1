// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/planes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "stages/slice/slice.h"
#include "tests/unit/slice/synthetic_cloud.h"

namespace roomcut::slice {
namespace {

using testing::SyntheticCloud;

constexpr double kDegree = std::numbers::pi / 180;

double pitch_of(const SlopedPlane& plane) {
  return std::atan(plane.gradient.norm()) / kDegree;
}

/// As ingest would: up to 23 degrees horizontal, up to 69 degrees sloped.
SurfaceClass class_of(double pitch) {
  return pitch < 23 ? SurfaceClass::kHorizontal : SurfaceClass::kSloped;
}

/// A room of 6 m x 5 m whose ceiling rises by that pitch along x, from 2.5 m on.
SyntheticCloud monopitch(double pitch, double noise_m = 0.004, double density = 500, double turned = 0) {
  SyntheticCloud cloud(noise_m, density);
  cloud.place(turned, {0.3, 0.7});
  const double rise = std::tan(pitch * kDegree);
  cloud.horizontal({0, 0}, {6, 5}, 0.0);
  cloud.surface(
      {0, 0}, {6, 5}, [rise](const Vec2& p) { return 2.5 + rise * p.x(); }, class_of(pitch));
  cloud.wall({0, 0}, {0, 5}, 0, 2.5);
  cloud.wall({6, 0}, {6, 5}, 0, 2.5 + 6 * rise);
  for (const double y : {0.0, 5.0}) {
    for (int i = 0; i < 12; ++i)
      cloud.wall({0.5 * i, y}, {0.5 * i + 0.5, y}, 0, 2.5 + rise * (0.5 * i + 0.25));
  }
  return cloud;
}

Slices slices_of(const SyntheticCloud& cloud) {
  return slice_cloud(cloud.header(), cloud.source(), {}).slices;
}

TEST(Planes, AMonopitchRoofOfAnyPitchIsOnePlane) {
  for (const double pitch : {1.5, 3.0, 7.0, 15.0, 22.0, 25.0, 40.0, 60.0}) {
    const SyntheticCloud cloud = monopitch(pitch, 0.004, 500, 0.4);
    const Slices slices = slices_of(cloud);
    ASSERT_EQ(slices.planes.size(), 1U) << pitch;
    const SlopedPlane& plane = slices.planes[0];
    EXPECT_NEAR(pitch_of(plane), pitch, 0.1);
    EXPECT_NEAR(std::atan2(plane.gradient.y(), plane.gradient.x()), 0.4, 0.01) << pitch;
    EXPECT_TRUE(plane.ceiling) << pitch;
    EXPECT_NEAR(plane.area_m2, 30, 0.05 * 30) << pitch;
    const double slack = 0.05 / std::cos(pitch * kDegree);
    EXPECT_NEAR(plane.range().first, 2.5, slack) << pitch;
    EXPECT_NEAR(plane.range().second, 2.5 + 6 * std::tan(pitch * kDegree), slack) << pitch;
  }
}

TEST(Planes, ItsPointsMakeNoLevelAndACapClosesItAboveTheRidge) {
  for (const double pitch : {3.0, 10.0, 20.0}) {
    const Slices slices = slices_of(monopitch(pitch));
    ASSERT_GE(slices.levels.size(), 3U);
    const double ridge = 2.5 + 6 * std::tan(pitch * kDegree);
    EXPECT_NEAR(slices.levels.front().z, 0, 0.002);
    EXPECT_TRUE(slices.levels.back().cap);
    EXPECT_NEAR(slices.levels.back().z, ridge + 0.3, 0.1);
    for (std::size_t k = 1; k + 1 < slices.levels.size(); ++k) {
      EXPECT_TRUE(slices.levels[k].step) << pitch << " " << slices.levels[k].z;
    }
  }
}

TEST(Planes, NoiseAndDensityHardlyTurnThem) {
  for (const auto& [noise, density] :
       {std::pair{0.002, 300.0}, {0.010, 300.0}, {0.010, 3000.0}, {0.005, 80.0}}) {
    const Slices slices = slices_of(monopitch(12, noise, density, 1.1));
    ASSERT_EQ(slices.planes.size(), 1U) << noise << " " << density;
    EXPECT_NEAR(pitch_of(slices.planes[0]), 12, 0.1);
  }
}

TEST(Planes, ARampUnderALevelCeilingIsAFloor) {
  SyntheticCloud cloud;
  cloud.horizontal({0, 0}, {20, 8}, 2.5);
  cloud.horizontal({0, 0}, {20, 8}, [](const Vec2& p) { return -0.06 * p.x(); });
  cloud.wall({0, 0}, {20, 0}, -1.2, 2.5);
  cloud.wall({0, 8}, {20, 8}, -1.2, 2.5);
  const Slices slices = slices_of(cloud);
  ASSERT_EQ(slices.planes.size(), 1U);
  EXPECT_FALSE(slices.planes[0].ceiling);
  EXPECT_TRUE(slices.levels.front().cap);
  EXPECT_LT(slices.levels.front().z, -1.3);
  EXPECT_NEAR(slices.levels.back().z, 2.5, 0.002);
}

TEST(Planes, TwoRoofPlanesMeetAtTheirRidge) {
  SyntheticCloud cloud;
  cloud.horizontal({0, 0}, {8, 9}, 0);
  cloud.wall({0, 0}, {8, 0}, 0, 2.25);
  cloud.surface(
      {0, 0}, {8, 9}, [](const Vec2& p) { return 4.5 - 0.5 * std::abs(p.y() - 4.5); }, SurfaceClass::kSloped);
  const Slices slices = slices_of(cloud);
  ASSERT_EQ(slices.planes.size(), 2U);
  for (const SlopedPlane& plane : slices.planes) {
    EXPECT_NEAR(plane.range().second, 4.5, 0.005);
    EXPECT_NEAR(plane.c + plane.gradient.dot(Vec2(4, 4.5)), 4.5, 0.005);
  }
}

TEST(Planes, AWallThatPartsARoofLeavesItOne) {
  SyntheticCloud cloud;
  for (const double x : {0.0, 4.3}) {
    cloud.horizontal({x, 0}, {x + 4, 5}, 0);
    cloud.wall({x, 0}, {x + 4, 0}, 0, 2);
    cloud.surface(
        {x, 0}, {x + 4, 5}, [](const Vec2& p) { return 2 + 0.6 * p.y(); }, SurfaceClass::kSloped);
  }
  EXPECT_EQ(slices_of(cloud).planes.size(), 1U);
}

TEST(Planes, ADriftingFloorIsALevel) {
  SyntheticCloud cloud;
  cloud.horizontal({0, 0}, {16, 8}, [](const Vec2& p) { return 0.06 * std::sin(0.5 * p.x() + 0.2 * p.y()); });
  cloud.horizontal({0, 0}, {16, 8},
                   [](const Vec2& p) { return 2.7 + 0.06 * std::sin(0.5 * p.x() - 0.3 * p.y()); });
  cloud.wall({0, 0}, {16, 0}, 0, 2.7);
  const Slices slices = slices_of(cloud);
  EXPECT_EQ(slices.planes.size(), 0U);
  EXPECT_EQ(slices.levels.size(), 2U);
}

TEST(Planes, ABarrelVaultIsFacetsNearItsSurface) {
  SyntheticCloud cloud;
  cloud.horizontal({0, -3}, {10, 3}, 0);
  for (const double y : {-3.0, 3.0}) cloud.wall({0, y}, {10, y}, 0, 3);
  const auto vault = [](const Vec2& p) { return 2 + std::sqrt(3.2 * 3.2 - p.y() * p.y()); };
  const auto part = [&](double y0, double y1, SurfaceClass of_class) {
    cloud.surface({0, y0}, {10, y1}, vault, of_class);
  };
  part(-1.25, 1.25, SurfaceClass::kHorizontal);  // 23 degrees
  part(-2.95, -1.25, SurfaceClass::kSloped);
  part(1.25, 2.95, SurfaceClass::kSloped);
  const Slices slices = slices_of(cloud);
  ASSERT_GE(slices.planes.size(), 4U);
  double area = 0;
  for (const SlopedPlane& plane : slices.planes) {
    area += plane.area_m2;
    EXPECT_LT(plane.rms_m, 0.04);
  }
  // In plan, as the made-up points weigh; a level at the crown may hold the rest.
  EXPECT_GT(area, 0.7 * 10 * 5.9);
}

TEST(Planes, FlatRoomsFurnitureAndNarrowSlopesHaveNone) {
  SyntheticCloud cloud(0.008);
  cloud.room({0, 0}, {8, 6}, 0.0, 2.6);
  cloud.horizontal({2, 2}, {3.5, 3}, 0.75);
  const auto sloped = [](const Vec2& p) { return 0.4 + 0.8 * p.y(); };
  cloud.surface({5, 1}, {6.2, 2}, sloped, SurfaceClass::kSloped);  // a slide
  cloud.surface({0, 0}, {8, 0.3}, sloped, SurfaceClass::kSloped);  // a rounded edge
  EXPECT_EQ(slices_of(cloud).planes.size(), 0U);
}

TEST(Planes, AnyNumberOfThreadsGivesTheSame) {
  const SyntheticCloud cloud = monopitch(30);
  std::vector<Slices> results;
  for (const std::size_t threads : {1, 2, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(slices_of(cloud));
  }
  for (const Slices& slices : results) {
    ASSERT_EQ(slices.planes.size(), results[0].planes.size());
    EXPECT_EQ(slices.planes[0].gradient, results[0].planes[0].gradient);
    EXPECT_EQ(slices.planes[0].c, results[0].planes[0].c);
    EXPECT_EQ(slices.planes[0].outline, results[0].planes[0].outline);
  }
}

}  // namespace
}  // namespace roomcut::slice
