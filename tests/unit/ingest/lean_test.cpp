// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/lean.h"

#include <Eigen/Geometry>
#include <numbers>

#include "common/geometry/level_turn.h"
#include "memory_scan.h"
#include "scan_files.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::vector<Vec3> turned(std::vector<Vec3> points, double degrees, const Vec3& axis) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(degrees * kDegree, axis.normalized()).toRotationMatrix();
  for (Vec3& point : points) point = turn * point;
  return points;
}

Lean lean_of_points(const std::vector<Vec3>& points, const ScanSettings& settings = {}) {
  const MemoryScan reader(points);
  const TiledScan scan = tile_scan(reader, settings, {});
  return lean_of(class_tiles(scan, {}, [](const CloudTile&, bool) {}).estimates.lean);
}

/// With the heights of the floors.
Lean exact_lean_of(const std::vector<Vec3>& points) {
  const MemoryScan reader(points);
  const TiledScan scan = tile_scan(reader, {}, {});
  FloorFit fit;
  const SurfaceSummary summary = class_tiles(scan, {}, [&](const CloudTile& part, bool) { fit.add(part); });
  return lean_of(summary.estimates.lean, fit);
}

Room house() {
  Room room;
  room.size = Vec3(8, 6, 2.7);
  room.angle = 0.4;
  return room;
}

TEST(Lean, is_that_of_floors_and_walls_of_a_tilted_scan) {
  for (const double degrees : {0.0, 0.1, 0.8, 1.5, 4.0, 6.5}) {
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(-1, 2, 0)}) {
      const Lean lean = lean_of_points(turned(house().points(), degrees, axis));
      EXPECT_NEAR(lean.degrees, degrees, 0.05) << degrees;
      EXPECT_TRUE(lean.walls_agree || degrees < 0.3) << degrees;
      const Vec3 up = Eigen::AngleAxisd(degrees * kDegree, axis.normalized()) * Vec3(0, 0, 1);
      EXPECT_LT((Vec3(lean.up[0], lean.up[1], lean.up[2]) - up).norm(), 0.05 * kDegree * 1.5) << degrees;
    }
  }
}

TEST(Lean, by_the_heights_of_floors_is_good_to_two_thousandths_of_a_degree) {
  for (const double degrees : {0.0, 0.8, 4.0}) {
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(-1, 2, 0)}) {
      const Lean lean = exact_lean_of(turned(house().points(), degrees, axis));
      const Vec3 up = Eigen::AngleAxisd(degrees * kDegree, axis.normalized()) * Vec3(0, 0, 1);
      EXPECT_LT((Vec3(lean.up[0], lean.up[1], lean.up[2]) - up).norm(), 0.002 * kDegree) << degrees;
    }
  }
}

TEST(Lean, by_heights_is_not_that_of_steps_tables_and_ramps_on_the_floor) {
  Room room = house();
  std::vector<Vec3> points = room.points();
  for (Vec3& point : points) {
    const Vec3 inside = room.to_room(point);
    if (inside.z() > 1) continue;
    point.z() += inside.x() > 5 ? 0.15 : (inside.x() < 2.5 ? 0.05 * (2.5 - inside.x()) : 0);
  }
  EXPECT_LT(exact_lean_of(points).degrees, 0.01);
  EXPECT_EQ(FloorFit().slope({0.01, 0.02}), (FloorFit::Slope{0.01, 0.02}));
}

TEST(Lean, is_gone_once_the_scan_is_turned_by_it) {
  const std::vector<Vec3> points = turned(house().points(), 1.5, Vec3(1, -1, 0));
  ScanSettings settings;
  settings.level = lean_of_points(points).up;
  EXPECT_LT(lean_of_points(points, settings).degrees, 0.05);
  std::vector<Vec3> far = points;
  for (Vec3& point : far) point += Vec3(691'000, 5'334'000, 500);
  EXPECT_LT(lean_of_points(far, settings).degrees, 0.05) << "turned about the origin that is subtracted";
}

TEST(Lean, of_a_ramp_is_not_confirmed_by_upright_walls) {
  std::vector<Vec3> points = house().points();
  for (Vec3& point : points) point.z() += 0.06 * point.x();
  const Lean lean = lean_of_points(points);
  EXPECT_NEAR(lean.degrees, 3.43, 0.1);
  EXPECT_FALSE(lean.walls_agree);
}

TEST(Lean, is_not_taken_from_a_roof_over_a_level_floor) {
  Room room = house();
  std::vector<Vec3> points = room.points();
  for (Vec3& point : points) {
    const double height = room.to_room(point).z();
    point.z() += 0.1 * room.to_room(point).x() * height / room.size.z();  // the ceiling rises by 10 %
  }
  EXPECT_LT(lean_of_points(points).degrees, 0.1);
}

TEST(Lean, is_none_without_planes) {
  EXPECT_EQ(lean_of(LeanSums()).degrees, 0);
  EXPECT_EQ(lean_of(LeanSums()).up, (std::array<double, 3>{0, 0, 1}));
}

TEST(LevelTurn, brings_up_onto_z_and_turns_back_without_mirroring) {
  const Vec3 up = Vec3(0.03, -0.02, 1).normalized();
  const double level[3] = {up.x(), up.y(), up.z()};
  const Eigen::Matrix3d turn = level_turn(level);
  EXPECT_LT((turn * up - Vec3(0, 0, 1)).norm(), 1e-15);
  EXPECT_LT((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_NEAR(turn.determinant(), 1, 1e-15);
  EXPECT_LT((turn * Vec3(0.02, 0.03, 0).normalized() - Vec3(0.02, 0.03, 0).normalized()).norm(), 1e-15)
      << "the smallest turn: its axis stays";
}

}  // namespace
}  // namespace roomcut::testing
