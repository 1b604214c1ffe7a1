// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/tripod.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/synthesize/test_scenes.h"

namespace roomcut::synthesize {
using namespace roomcut::test;

namespace {

using nlohmann::json;

json tripod(std::uint64_t points) {
  return {
      {"sampling", {{"kind", "tripod"}, {"points", points}, {"stations", json::parse("[[1.5, 1.2, 1.4]]")}}}};
}

Vec3 at(const std::vector<float>& xyz, std::size_t i) {
  return {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
}

TEST(TripodScan, MeetsTheWantedNumberOfPointsAndLiesOnTheSurface) {
  const auto xyz = test::all_points(test::box_scene(tripod(50000)));
  EXPECT_NEAR(static_cast<double>(xyz.size()) / 3, 50000, 500);
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    ASSERT_LT(std::abs(test::box_distance(at(xyz, i), Vec3(0, 0, 0), Vec3(4, 3, 2.5))), 1e-5);
  }
}

TEST(TripodScan, ComesInScanOrderWithABlindConeBelow) {
  const auto xyz = test::all_points(test::box_scene(tripod(20000)));
  double turned = 0;
  Vec3 before = at(xyz, 0) - Vec3(1.5, 1.2, 1.4);
  for (std::size_t i = 1; i < xyz.size() / 3; ++i) {
    const Vec3 d = at(xyz, i) - Vec3(1.5, 1.2, 1.4);
    EXPECT_GT(std::atan2(d.head<2>().norm(), -d.z()), 0.5236 - 1e-4);
    if (d.head<2>().norm() < 0.3) continue;  // near the zenith
    const double step =
        std::remainder(std::atan2(d.y(), d.x()) - std::atan2(before.y(), before.x()), 2 * std::numbers::pi);
    EXPECT_LT(std::abs(step), 0.2);
    turned += step;
    before = d;
  }
  EXPECT_NEAR(turned, 2 * std::numbers::pi, 0.2);  // once around, column by column
}

TEST(TripodScan, SeesTheOtherRoomOnlyThroughTheDoor) {
  json scene = test::two_rooms_json();
  scene.update(tripod(40000));
  const auto xyz = test::all_points(scene_from_json(scene, "s"));
  const Vec3 station(1.5, 1.2, 1.4);
  int beyond = 0;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Vec3 p = at(xyz, i);
    if (p.x() < 4.2 + 1e-5) continue;
    ++beyond;
    for (const double x : {4.0, 4.2}) {  // the beam passed the doorway
      const Vec3 through = station + (x - station.x()) / (p.x() - station.x()) * (p - station);
      EXPECT_GT(through.y(), 1.1 - 1e-4);
      EXPECT_LT(through.y(), 1.9 + 1e-4);
      EXPECT_GT(through.z(), 0.1 - 1e-4);
      EXPECT_LT(through.z(), 2.1 + 1e-4);
    }
  }
  EXPECT_GT(beyond, 300);
}

TEST(TripodScan, BeamsLeaveThroughWindows) {
  json more = tripod(40000);
  more["windows"] =
      json::parse(R"([{"room": "a", "at": [2, 0], "width": 2, "height": 1, "sill": 1, "depth": 0.2}])");
  const auto xyz = test::all_points(test::box_scene(more));
  int reveal = 0;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Vec3 p = at(xyz, i);
    EXPECT_GT(p.y(), -0.2 - 1e-5);
    EXPECT_FALSE(std::abs(p.x() - 2) < 0.999 && std::abs(p.z() - 1.5) < 0.499 && p.y() < 1e-3)
        << p.transpose();
    if (p.y() < -0.001) ++reveal;
  }
  EXPECT_GT(reveal, 20);
}

TEST(TripodScan, NoiseRunsAlongTheBeam) {
  json more = tripod(40000);
  more["noise_m"] = 0.01;
  const auto xyz = test::all_points(test::box_scene(more));
  const Vec3 station(1.5, 1.2, 1.4);
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Vec3 p = at(xyz, i);
    if (p.x() < 3.9 || std::abs(p.y() - 1.5) > 1 || std::abs(p.z() - 1.2) > 1) continue;  // the wall x = 4
    const Vec3 d = (p - station).normalized();
    squares += std::pow((p.x() - 4) / d.x(), 2);
    ++count;
  }
  ASSERT_GT(count, 1000);
  EXPECT_NEAR(std::sqrt(squares / count), 0.01, 4 * 0.01 / std::sqrt(2.0 * count));
}

TEST(TripodScan, StationsAreChosenSoThatTheWholeFloorIsNear) {
  json scene = json::parse(R"({"storeys": [{"floor": 0, "ceiling": 2.5,
      "rooms": [{"name": "long", "polygon": [[0,0],[30,0],[30,2],[0,2]]}]}], "sampling": {"kind": "tripod", "points": 10}})");
  const Building building = place(scene_from_json(scene, "s"));
  EXPECT_GE(building.stations.size(), 3U);
  EXPECT_LE(building.stations.size(), 6U);
  for (double x = 0.5; x < 30; x += 0.5) {
    double nearest = 1e9;
    for (const Vec3& s : building.stations) nearest = std::min(nearest, (s.head<2>() - Vec2(x, 1)).norm());
    EXPECT_LT(nearest, 6.5);
  }
}

}  // namespace
}  // namespace roomcut::synthesize
