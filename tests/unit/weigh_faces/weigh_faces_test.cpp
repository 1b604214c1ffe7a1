// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/weigh_faces.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <numeric>

#include "tests/unit/weigh_faces/grid_complex.h"
#include "tests/unit/weigh_faces/sampled_cloud.h"

namespace roomcut::weigh_faces {
namespace {

FaceWeights weigh(const CellComplex& complex, const SampledCloud& cloud) {
  FaceWeigher weigher(complex, cloud.header(), {});
  weigher.add(cloud.tile);
  return weigher.weigh();
}

/// Two rooms of 4 × 4 × 2.6 m, a wall of `thickness` between them at x = 4, and the space around.
struct TwoRooms {
  explicit TwoRooms(double thickness, const std::vector<double>& levels = {-0.3, 0, 2.6, 2.9})
      : x(thickness),
        complex(
            grid_complex({-1, 0, 4, 4 + thickness, 8 + thickness, 9 + thickness}, {-1, 0, 4, 5}, levels)) {}
  double x;
  CellComplex complex;
  std::size_t west() const {
    return edge_near(complex, {4, 2});
  }  // face of the west room: empty on its left (north-going edge)
  std::size_t east() const { return edge_near(complex, {4 + x, 2}); }
  void sample(SampledCloud& cloud) const {
    cloud.room(0, 4, 0, 4, 0, 2.6);
    cloud.room(4 + x, 8 + x, 0, 4, 0, 2.6);
  }
};

TEST(WeighFaces, CoveredWallsCountFullyAndUncoveredNotAtAll) {
  const TwoRooms scene(0.1);
  SampledCloud cloud(400, 0.004);
  scene.sample(cloud);
  const FaceWeights w = weigh(scene.complex, cloud);
  EXPECT_GT(w.wall_omega[scene.complex.wall_face(scene.west(), 1)], 0.95);
  EXPECT_GT(w.wall_omega[scene.complex.wall_face(scene.east(), 1)], 0.95);
  EXPECT_LT(w.wall_omega[scene.complex.wall_face(scene.west(), 0)], 0.2) << "inside the slab";
  EXPECT_LT(w.wall_omega[scene.complex.wall_face(edge_near(scene.complex, {4.05, 0}), 1)], 0.1)
      << "end of the wall";
  EXPECT_LT(w.wall_omega[scene.complex.wall_face(edge_near(scene.complex, {-0.5, 0}), 1)], 0.05) << "outside";
}

TEST(WeighFaces, HalfCoveredWallWeighsOneHalf) {
  const CellComplex complex = grid_complex({-1, 0, 4, 5}, {-1, 0, 4, 5}, {0, 2.6});
  for (const double density : {100.0, 400.0}) {
    SampledCloud cloud(density, 0.004);
    cloud.wall({0, 0}, {0, 2}, 0, 2.6);
    const FaceWeights w = weigh(complex, cloud);
    EXPECT_NEAR(w.wall_omega[complex.wall_face(edge_near(complex, {0, 2}), 0)], 0.5, 0.05) << density;
  }
}

TEST(WeighFaces, AnisotropicDensityDoesNotLowerTheWeight) {
  const CellComplex complex = grid_complex({-1, 0, 4, 5}, {-1, 0, 4, 5}, {0, 2.6});
  SampledCloud cloud(1000, 0.004);
  cloud.keep = [](const Vec3& p) { return 1 - 0.9 * p.y() / 4; };  // falls to a tenth along the wall
  cloud.wall({0, 0}, {0, 4}, 0, 2.6);
  cloud.flat(0, 4, 0, 4, 0);
  const FaceWeights w = weigh(complex, cloud);
  EXPECT_GT(w.wall_omega[complex.wall_face(edge_near(complex, {0, 2}), 0)], 0.9);
  EXPECT_GT(w.level_omega[complex.level_face(4, 0)], 0.9);
}

TEST(WeighFaces, ThinWallFacesTurnTheirBacksToEachOther) {
  for (const double noise : {0.003, 0.006, 0.01}) {
    for (const double thickness : {0.1, 0.2}) {
      const TwoRooms scene(thickness);
      SampledCloud cloud(400, noise);
      scene.sample(cloud);
      const FaceWeights w = weigh(scene.complex, cloud);
      const std::size_t west = scene.complex.wall_face(scene.west(), 1);
      const std::size_t east = scene.complex.wall_face(scene.east(), 1);
      EXPECT_GT(w.wall_left[west], 0.9 * w.wall_omega[west]) << noise << " " << thickness;
      EXPECT_LT(w.wall_right[west], 0.1 * w.wall_omega[west]) << noise << " " << thickness;
      EXPECT_GT(w.wall_right[east], 0.9 * w.wall_omega[east]) << noise << " " << thickness;
      EXPECT_LT(w.wall_left[east], 0.1 * w.wall_omega[east]) << noise << " " << thickness;
    }
  }
}

TEST(WeighFaces, AcrossAThinWallTheOtherRoomIsNotTheWallsBackSide) {
  // 6 cm of wall and 2 cm of noise: what lies 8 cm beside a face is the other room, whose ceiling is lower.
  const TwoRooms scene(0.06, {-0.3, 0, 2.3, 2.6, 2.9});
  SampledCloud cloud(400, 0.02);
  cloud.room(0, 4, 0, 4, 0, 2.6);
  cloud.room(4.06, 8.06, 0, 4, 0, 2.3);
  const FaceWeights w = weigh(scene.complex, cloud);
  const std::size_t west = scene.complex.wall_face(scene.west(), 1);
  const std::size_t east = scene.complex.wall_face(scene.east(), 1);
  EXPECT_GT(w.wall_left[west], 0.8 * w.wall_omega[west]);
  EXPECT_GT(w.wall_right[east], 0.8 * w.wall_omega[east]);
}

TEST(WeighFaces, ADoorsHeadAndThresholdDoNotTurnItsWall) {
  // The west room lies lower; a ceiling elsewhere is as high as the door.
  const TwoRooms scene(0.1, {-0.3, 0, 0.2, 2.05, 2.6, 2.9});
  SampledCloud cloud(400, 0.004);
  cloud.keep = [](const Vec3& p) {
    return p.x() > 3.9 && p.x() < 4.2 && p.y() > 1 && p.y() < 2.2 && p.z() > 0.3 && p.z() < 2.05 ? 0.0 : 1.0;
  };
  cloud.room(0, 4, 0, 4, 0, 2.6);
  cloud.room(4.1, 8.1, 0, 4, 0.2, 2.6);
  cloud.keep = nullptr;
  cloud.flat(4, 4.1, 1, 2.2, 0.2);
  cloud.flat(4, 4.1, 1, 2.2, 2.05);
  const FaceWeights w = weigh(scene.complex, cloud);
  const std::size_t west = scene.complex.wall_face(scene.west(), 2);
  ASSERT_GT(w.wall_omega[west], 0.4);
  EXPECT_GT(w.wall_left[west], 0.8 * w.wall_omega[west]);
}

TEST(WeighFaces, FurnitureInFrontOfAWallDoesNotTurnIt) {
  const TwoRooms scene(0.1);
  SampledCloud cloud(400, 0.004);
  cloud.keep = [](const Vec3& p) {
    return p.x() > 3.4 && p.x() < 4.05 && p.y() > 1 && p.y() < 3 && p.z() < 1.9 ? 0.0 : 1.0;
  };
  scene.sample(cloud);
  cloud.keep = nullptr;
  cloud.wall({3.4, 1}, {3.4, 3}, 0, 1.9);
  const FaceWeights w = weigh(scene.complex, cloud);
  const std::size_t west = scene.complex.wall_face(scene.west(), 1);
  EXPECT_GT(w.wall_omega[west], 0.9) << "by its top quarter";
  EXPECT_GT(w.wall_left[west], 0.9 * w.wall_omega[west]);
}

TEST(WeighFaces, ABeamOverAFloorThatIsSeenOnBothSidesIsNoWall) {
  for (const double density : {100.0, 400.0}) {
    const TwoRooms scene(0.3);
    SampledCloud cloud(density, 0.004);
    cloud.flat(0, 8.3, 0, 4, 0);
    cloud.wall({4, 0}, {4, 4}, 2.35, 2.6);
    cloud.wall({4.3, 0}, {4.3, 4}, 2.35, 2.6);
    const FaceWeights w = weigh(scene.complex, cloud);
    EXPECT_FALSE(w.is_wall(scene.complex.wall_face(scene.west(), 1))) << density;
    EXPECT_FALSE(w.is_wall(scene.complex.wall_face(scene.east(), 1))) << density;
  }
}

TEST(WeighFaces, AboveADoorAsWideAsTheCorridorIsAWall) {
  const TwoRooms scene(0.3);
  SampledCloud cloud(400, 0.004);
  cloud.flat(0, 8.3, 0, 4, 0);
  cloud.wall({4, 0}, {4, 4}, 2.1, 2.6);
  const FaceWeights w = weigh(scene.complex, cloud);
  EXPECT_TRUE(w.is_wall(scene.complex.wall_face(scene.west(), 1)));
}

TEST(WeighFaces, AThinWallBehindACupboardCountsByItsTop) {
  // A wall of 4 cm is one line, with a floor on both sides but for the cupboard's place.
  const CellComplex complex = grid_complex({-1, 0, 4, 8, 9}, {-1, 0, 4, 5}, {-0.3, 0, 2.6, 2.9});
  SampledCloud cloud(400, 0.004);
  cloud.keep = [](const Vec3& p) { return p.x() > 3.4 && p.z() < 1.9 ? 0.0 : 1.0; };
  cloud.room(0, 4, 0, 4, 0, 2.6);
  cloud.keep = nullptr;
  cloud.flat(4.04, 8, 0, 4, 0);
  const FaceWeights w = weigh(complex, cloud);
  EXPECT_GT(w.wall_omega[complex.wall_face(edge_near(complex, {4, 2}), 1)], 0.9);
}

TEST(WeighFaces, ThePlanInsideAThinWallHasNoFloor) {
  const TwoRooms scene(0.1);
  SampledCloud cloud(400, 0.005);
  scene.sample(cloud);
  const FaceWeights w = weigh(scene.complex, cloud);
  const std::size_t wall = 1 * 5 + 2;  // face between x = 4 and 4.1
  EXPECT_LT(w.level_omega[scene.complex.level_face(wall, 1)], 0.05);
  EXPECT_LT(w.level_omega[scene.complex.level_face(wall, 2)], 0.05);
  EXPECT_GT(w.level_omega[scene.complex.level_face(wall - 1, 1)], 0.95);
  EXPECT_GT(w.level_omega[scene.complex.level_face(wall + 1, 2)], 0.95);
}

TEST(WeighFaces, FloorsAndCeilingsAreToldApartOnThinSlabs) {
  for (const double noise : {0.003, 0.01}) {
    const CellComplex complex = grid_complex({-1, 0, 4, 5}, {-1, 0, 4, 5}, {0, 2.5, 2.65, 5.15});
    SampledCloud cloud(400, noise);
    cloud.room(0, 4, 0, 4, 0, 2.5);
    cloud.room(0, 4, 0, 4, 2.65, 5.15);
    const FaceWeights w = weigh(complex, cloud);
    const std::size_t room = 4;
    for (const std::size_t floor : {0UL, 2UL}) {
      EXPECT_GT(w.level_floor[complex.level_face(room, floor)], 0.9) << noise;
      EXPECT_LT(w.level_ceiling[complex.level_face(room, floor)], 0.1) << noise;
    }
    for (const std::size_t ceiling : {1UL, 3UL}) {
      EXPECT_GT(w.level_ceiling[complex.level_face(room, ceiling)], 0.9) << noise;
      EXPECT_LT(w.level_floor[complex.level_face(room, ceiling)], 0.1) << noise;
    }
  }
}

TEST(WeighFaces, HalfAFloorWeighsOneHalf) {
  const CellComplex complex = grid_complex({-1, 0, 4, 5}, {-1, 0, 4, 5}, {0, 2.6});
  SampledCloud cloud(200, 0.004);
  cloud.flat(0, 2, 0, 4, 0);
  const FaceWeights w = weigh(complex, cloud);
  EXPECT_NEAR(w.level_omega[complex.level_face(4, 0)], 0.5, 0.05);
}

TEST(WeighFaces, EveryWallPointIsGivenToOneLineOnly) {
  const CellComplex complex = grid_complex({-1, 0, 0.03, 4}, {-1, 0, 4, 5}, {0, 2.6});
  SampledCloud cloud(400, 0.01);
  cloud.wall({0, 0}, {0, 4}, 0, 2.6);
  const FaceWeights w = weigh(complex, cloud);
  const std::uint64_t given = std::accumulate(w.wall_points.begin(), w.wall_points.end(), std::uint64_t{0});
  EXPECT_LE(given, cloud.tile.size());
  EXPECT_GT(given, 0.95 * static_cast<double>(cloud.tile.size())) << "all but the margins";
  const std::size_t own = complex.wall_face(edge_near(complex, {0, 2}), 0);
  const std::size_t other = complex.wall_face(edge_near(complex, {0.03, 2}), 0);
  EXPECT_GT(w.wall_points[own], 10 * w.wall_points[other]);
}

TEST(WeighFaces, InACornerAPointWithoutAClassIsTheWallsOnWhichItLies) {
  // A corner at (0, 0), and 10 cm from it a line that has its wall elsewhere.
  const CellComplex complex = grid_complex({-1, 0, 4}, {-1, 0, 0.1, 4}, {0, 2.6});
  SampledCloud cloud(400, 0.004);
  cloud.wall({0, 0.005}, {0, 4}, 0, 2.6);
  cloud.wall({0.005, 0}, {4, 0}, 0, 2.6);
  std::fill(cloud.tile.surface.begin(), cloud.tile.surface.end(),
            static_cast<std::uint8_t>(SurfaceClass::kNone));
  const FaceWeights w = weigh(complex, cloud);
  EXPECT_GT(w.wall_omega[complex.wall_face(edge_near(complex, {0, 0.05}), 0)], 0.8)
      << "the strip in the corner";
  EXPECT_GT(w.wall_omega[complex.wall_face(edge_near(complex, {2, 0}), 0)], 0.9);
  EXPECT_LT(w.wall_omega[complex.wall_face(edge_near(complex, {-0.5, 0}), 0)], 0.1) << "behind the wall";
  EXPECT_LT(w.wall_omega[complex.wall_face(edge_near(complex, {2, 0.1}), 0)], 0.1) << "no wall there";
  EXPECT_LT(w.wall_omega[complex.wall_face(edge_near(complex, {0, -0.5}), 0)], 0.1);
}

/// As sparse scans have it at a wall's foot: every point up to `high` above the floor is of class `surface`.
FaceWeights with_foot(const CellComplex& complex, SurfaceClass surface, double high) {
  SampledCloud cloud(400, 0.004);
  cloud.wall({0, 0}, {0, 4}, 0, 2.6);
  cloud.flat(0, 4, 0, 4, 0);
  for (std::size_t i = 0; i < cloud.tile.size(); ++i) {
    if (cloud.tile.z[i] < high && static_cast<SurfaceClass>(cloud.tile.surface[i]) == SurfaceClass::kWall) {
      cloud.tile.surface[i] = static_cast<std::uint8_t>(surface);
    }
  }
  return weigh(complex, cloud);
}

TEST(WeighFaces, AtItsFootAWallIsCoveredWhateverTheVoxelsThereMadeOfItsPoints) {
  const CellComplex complex = grid_complex({-1, 0, 4, 5}, {-1, 0, 4, 5}, {0, 0.15, 2.6});
  const std::size_t foot = complex.wall_face(edge_near(complex, {0, 2}), 0);
  const double as_wall = with_foot(complex, SurfaceClass::kWall, 0.2).wall_omega[foot];
  EXPECT_GT(as_wall, 0.9);
  EXPECT_GT(with_foot(complex, SurfaceClass::kHorizontal, 0.2).wall_omega[foot], 0.4);
  EXPECT_GT(with_foot(complex, SurfaceClass::kNone, 0.2).wall_omega[foot], 0.9 * as_wall);
}

TEST(WeighFaces, AFloorThatGoesThroughALineIsNoFootOfAWall) {
  const CellComplex complex = grid_complex({-1, 0, 4}, {-1, 0, 4, 5}, {0, 0.15, 2.6});
  SampledCloud cloud(400, 0.004);
  cloud.flat(-1, 4, 0, 4, 0.03);  // drifted
  const FaceWeights w = weigh(complex, cloud);
  EXPECT_EQ(w.wall_points[complex.wall_face(edge_near(complex, {0, 2}), 0)], 0U);
  EXPECT_GT(w.level_omega[complex.level_face(3, 0)], 0.9);
}

TEST(WeighFaces, WallPointsOfAnotherDirectionDoNotCount) {
  const CellComplex complex = grid_complex({-1, 0, 4, 5}, {-1, 0, 4, 5}, {0, 2.6});
  SampledCloud cloud(2000, 0.004);
  cloud.wall({-0.03, 1}, {0.03, 1}, 0, 2.6);  // a short wall across the line x = 0
  const FaceWeights w = weigh(complex, cloud);
  EXPECT_EQ(w.wall_points[complex.wall_face(edge_near(complex, {0, 2}), 0)], 0U);
}

TEST(WeighFaces, ALineTakesNoPointsInLayersWhereItMayNotCarryAWall) {
  CellComplex complex = grid_complex({-1, 0, 0.05, 4}, {-1, 0, 4, 5}, {0, 2.5, 5});
  complex.lines[0].layers = {1};
  SampledCloud cloud(400, 0.003);
  cloud.wall({0.02, 0}, {0.02, 4}, 0, 5);
  const FaceWeights w = weigh(complex, cloud);
  const std::size_t barred = edge_near(complex, {0, 2});
  EXPECT_EQ(w.wall_omega[complex.wall_face(barred, 0)], 0);
  EXPECT_GT(w.wall_omega[complex.wall_face(barred, 1)], 0.95);
  EXPECT_GT(w.wall_omega[complex.wall_face(edge_near(complex, {0.05, 2}), 0)], 0.95)
      << "the next line takes them";
}

TEST(WeighFaces, ASliverCutOffByALineThatCarriesNothingThereTurnsNoWall) {
  // A line of another storey 5 cm before the wall at x = 4; the wall's own back side has a floor: a door.
  CellComplex complex = grid_complex({-1, 0, 3.95, 4, 8}, {-1, 0, 4, 5}, {0, 2.5, 5});
  SampledCloud cloud(100, 0.003);
  cloud.wall({4, 0}, {4, 4}, 0, 2.5);
  cloud.flat(0, 3.9, 0, 4, 0);
  cloud.flat(0, 3.9, 0, 4, 2.5);
  cloud.flat(4, 8, 1, 2, 0);
  const std::size_t wall = complex.wall_face(edge_near(complex, {4, 2}), 0);
  const FaceWeights both = weigh(complex, cloud);
  EXPECT_LT(both.wall_left[wall], 0.5 * both.wall_omega[wall]) << "the sliver has no floor";
  complex.lines[1].layers = {1};
  const FaceWeights own = weigh(complex, cloud);
  EXPECT_GT(own.wall_left[wall], 0.9 * own.wall_omega[wall]);
}

TEST(WeighFaces, PointsInARoomAreCountedInItsCellAndNotThoseOnItsFaces) {
  const TwoRooms scene(0.1);
  SampledCloud cloud(400, 0.004);
  scene.sample(cloud);
  const FaceWeights before = weigh(scene.complex, cloud);
  for (int i = 0; i < 50; ++i) {
    cloud.point({2 + 0.01 * i, 2, 1}, SurfaceClass::kNone, 0);
  }
  const FaceWeights after = weigh(scene.complex, cloud);
  const std::size_t room = scene.complex.cell(1 * 5 + 1, 1);
  EXPECT_EQ(before.cell_points[room], 0U);
  EXPECT_EQ(after.cell_points[room], 50U);
}

TEST(WeighFaces, AnyOrderOfPointsAndAnyNumberOfThreadsGivesTheSame) {
  const TwoRooms scene(0.1);
  SampledCloud cloud(200, 0.006);
  scene.sample(cloud);
  const FaceWeights whole = weigh(scene.complex, cloud);
  std::vector<CloudTile> parts(7);
  for (std::size_t i = cloud.tile.size(); i-- > 0;) {
    CloudTile& part = parts[i % parts.size()];
    part.x.push_back(cloud.tile.x[i]);
    part.y.push_back(cloud.tile.y[i]);
    part.z.push_back(cloud.tile.z[i]);
    part.surface.push_back(cloud.tile.surface[i]);
    part.azimuth.push_back(cloud.tile.azimuth[i]);
    part.area.push_back(cloud.tile.area[i]);
  }
  const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
  FaceWeigher weigher(scene.complex, cloud.header(), {});
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) { weigher.add(parts[i]); });
  const FaceWeights pieces = weigher.weigh();
  EXPECT_EQ(whole.wall_omega, pieces.wall_omega);
  EXPECT_EQ(whole.wall_left, pieces.wall_left);
  EXPECT_EQ(whole.wall_right, pieces.wall_right);
  EXPECT_EQ(whole.wall_points, pieces.wall_points);
  EXPECT_EQ(whole.level_omega, pieces.level_omega);
  EXPECT_EQ(whole.level_floor, pieces.level_floor);
  EXPECT_EQ(whole.level_ceiling, pieces.level_ceiling);
  EXPECT_EQ(whole.level_points, pieces.level_points);
  EXPECT_EQ(whole.cell_points, pieces.cell_points);
}

}  // namespace
}  // namespace roomcut::weigh_faces
