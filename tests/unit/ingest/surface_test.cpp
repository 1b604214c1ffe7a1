// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include "memory_scan.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Scores {
  double right_class = 0;
  double right_azimuth = 0;  ///< of the wall points that are classed as walls
};

/// Judges the points away from the room's edges.
Scores judge(const Room& room, const MadeCloud& cloud, double azimuth_tolerance, double clear = 0.25) {
  double points = 0;
  double right = 0;
  double walls = 0;
  double along = 0;
  for_points(cloud, [&](const Vec3& p, SurfaceClass surface, std::uint8_t azimuth, double) {
    const int face = room.face_at(p, clear);
    if (face < 0) {
      return;
    }
    ++points;
    const SurfaceClass expected = face == 2 ? SurfaceClass::kHorizontal : SurfaceClass::kWall;
    right += surface == expected ? 1 : 0;
    if (face < 2 && surface == SurfaceClass::kWall) {
      ++walls;
      const double truth = room.angle + (face == 0 ? 0 : std::numbers::pi / 2);
      along += angle_between(azimuth_of(azimuth), truth) < azimuth_tolerance ? 1 : 0;
    }
  });
  return {right / points, along / walls};
}

struct Case {
  double noise_m, density, angle_deg;
};

class Surface : public ::testing::TestWithParam<Case> {
 protected:
  Room room() const {
    Room room;
    room.noise_m = GetParam().noise_m;
    room.density = GetParam().density;
    room.angle = GetParam().angle_deg * kDegree;
    return room;
  }
};

TEST_P(Surface, has_the_right_class_azimuth_noise_density_and_area) {
  const Room truth = room();
  const MadeCloud cloud = make_cloud(MemoryScan(truth.points()));
  const double clear =
      std::max(0.25, 3.5 / std::sqrt(truth.density));  // sparse points need large neighbourhoods
  const Scores scores = judge(truth, cloud, 8 * kDegree, clear);
  EXPECT_GE(scores.right_class, 0.98);
  EXPECT_GE(scores.right_azimuth, 0.98);
  EXPECT_NEAR(cloud.header.noise_m / truth.noise_m, 1, 0.1);
  EXPECT_NEAR(cloud.header.density / truth.density, 1, 0.15);
  double area = 0;
  double floor_area = 0;
  for_points(cloud, [&](const Vec3& p, SurfaceClass, std::uint8_t, double a) {
    area += a;
    floor_area += truth.face_at(p, 0.25) == 2 ? a : 0;
  });
  EXPECT_NEAR(area / truth.surface(), 1, truth.density > 100 ? 0.05 : 0.1);
  EXPECT_NEAR(floor_area / (2 * 5.5 * 4.5), 1, 0.05) << "away from the edges";
}

INSTANTIATE_TEST_SUITE_P(Rooms, Surface,
                         ::testing::Values(Case{0.001, 500, 17}, Case{0.003, 1000, 0}, Case{0.003, 500, 45},
                                           Case{0.005, 3000, 31}, Case{0.01, 500, 60}, Case{0.01, 2000, 45},
                                           Case{0.02, 500, 17}, Case{0.02, 2000, 0}, Case{0.005, 150, 17},
                                           Case{0.005, 60, 5}));

TEST(SurfaceClasses, are_right_where_a_plane_slopes) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 5);
  std::normal_distribution<double> error(0, 0.004);
  std::vector<Vec3> points;
  const Vec3 normal(-std::sin(40 * kDegree), 0, std::cos(40 * kDegree));
  const Vec3 along(std::cos(40 * kDegree), 0, std::sin(40 * kDegree));
  points.reserve(25'000);
  for (int i = 0; i < 25'000; ++i) {
    points.emplace_back(unit(random) * along + Vec3(0, unit(random), 0) + error(random) * normal);
  }
  std::size_t sloped = 0;
  double area = 0;
  for_points(make_cloud(MemoryScan(points)),
             [&](const Vec3&, SurfaceClass surface, std::uint8_t azimuth, double a) {
               sloped += surface == SurfaceClass::kSloped ? 1 : 0;
               area += a;
               EXPECT_EQ(azimuth, 0);
             });
  EXPECT_GE(sloped, 24'500U);
  EXPECT_NEAR(area, 25, 2.5);
}

TEST(SurfaceClasses, are_none_where_a_sparse_neighbourhood_holds_a_floor_and_a_wall) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> error(0, 0.005);
  std::vector<Vec3> points;
  constexpr int kDensity = 230;              // neighbourhoods of 30 and 60 cm
  for (int i = 0; i < 16 * kDensity; ++i) {  // two floors 15 cm apart, and the step between them
    points.emplace_back(4 * unit(random), 2 * unit(random) - 2, error(random));
    points.emplace_back(4 * unit(random), 2 * unit(random), 0.15 + error(random));
  }
  for (int i = 0; i < 4 * 3 * kDensity; ++i) {  // a wall across
    points.emplace_back(error(random), 4 * unit(random) - 2, 0.15 + 2.85 * unit(random));
  }
  std::size_t near = 0;
  std::size_t sloped = 0;
  for_points(make_cloud(MemoryScan(points)), [&](const Vec3& p, SurfaceClass surface, std::uint8_t, double) {
    const bool edge = (p.x() < 0.2 && p.z() < 0.35) || std::abs(p.y()) < 0.15;
    near += edge ? 1 : 0;
    sloped += edge && surface == SurfaceClass::kSloped ? 1 : 0;
  });
  EXPECT_GT(near, 500U);
  EXPECT_LT(static_cast<double>(sloped) / static_cast<double>(near), 0.1);
}

TEST(SurfaceClasses, tell_a_ceiling_from_the_floor_above_it_in_sparse_scans) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> error(0, 0.004);
  constexpr int kDensity = 58;  // neighbourhoods of 60 cm hold both faces of the slab
  for (const double thickness : {0.25, 0.3, 0.4}) {
    for (const double height : {2.50, 2.57, 2.6, 2.73}) {
      std::vector<Vec3> points;
      points.reserve(2 * 36 * kDensity);
      for (int i = 0; i < 2 * 36 * kDensity; ++i) {
        points.emplace_back(6 * unit(random), 6 * unit(random), height + (i % 2) * thickness + error(random));
      }
      std::size_t level = 0;
      double area = 0;
      for_points(make_cloud(MemoryScan(points)),
                 [&](const Vec3&, SurfaceClass surface, std::uint8_t, double a) {
                   level += surface == SurfaceClass::kHorizontal ? 1 : 0;
                   area += surface == SurfaceClass::kHorizontal ? a : 0;
                 });
      EXPECT_GT(static_cast<double>(level), 0.9 * static_cast<double>(points.size()))
          << thickness << " " << height;
      EXPECT_NEAR(area, 72, 10) << thickness << " " << height;
    }
  }
}

TEST(SurfaceClasses, of_points_all_over_a_volume_are_none) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0, 2);
  std::vector<Vec3> points;
  points.reserve(40'000);
  for (int i = 0; i < 40'000; ++i) {
    points.emplace_back(unit(random), unit(random), unit(random));
  }
  std::size_t classed = 0;
  for_points(make_cloud(MemoryScan(points)), [&](const Vec3&, SurfaceClass surface, std::uint8_t, double) {
    classed += surface == SurfaceClass::kNone ? 0 : 1;
  });
  EXPECT_LT(classed, 6'000U) << "17 points in each neighbourhood: some look flat by chance";
}

TEST(Noise, is_not_that_of_neighbourhoods_with_both_faces_of_a_wall) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> error(0, 0.005);
  std::vector<Vec3> points;
  constexpr int kDensity = 160;  // a neighbourhood with 20 points is wider than the wall is thick
  points.reserve(40 * kDensity);
  for (int i = 0; i < 2 * 12 * kDensity; ++i) {
    points.emplace_back(4 * unit(random), (i % 2) * 0.12 + error(random), 3 * unit(random));
  }
  for (int i = 0; i < 16 * kDensity; ++i) {
    points.emplace_back(4 * unit(random), -0.3 - 4 * unit(random), error(random));
  }
  EXPECT_NEAR(make_cloud(MemoryScan(points)).header.noise_m, 0.005, 0.0005);
}

TEST(SurfaceClasses, keep_the_two_faces_of_a_thin_wall_apart) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 4);
  std::normal_distribution<double> error(0, 0.005);
  std::vector<Vec3> points;
  points.reserve(48'000);
  for (int i = 0; i < 48'000; ++i) {
    points.emplace_back(unit(random), (i % 2) * 0.12 + error(random), unit(random) * 0.75);
  }
  std::size_t walls = 0;
  const MadeCloud cloud = make_cloud(MemoryScan(points));
  for_points(cloud, [&](const Vec3&, SurfaceClass surface, std::uint8_t azimuth, double) {
    walls += surface == SurfaceClass::kWall &&
             angle_between(azimuth_of(azimuth), std::numbers::pi / 2) < 8 * kDegree;
  });
  EXPECT_GE(walls, 46'500U);
  EXPECT_NEAR(cloud.header.noise_m, 0.005, 0.0005);
}

TEST(SurfaceAreas, count_the_gaps_between_scan_lines) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(0, 8);
  std::normal_distribution<double> error(0, 0.003);
  std::vector<Vec3> points;
  for (int line = 0; line < 66; ++line) {  // lines 12 cm apart, 200 points per metre along them
    for (int i = 0; i < 1600; ++i) {
      points.emplace_back(unit(random), 0.06 + 0.12 * line, error(random));
    }
  }
  double area = 0;
  std::size_t horizontal = 0;
  for_points(make_cloud(MemoryScan(points)),
             [&](const Vec3& p, SurfaceClass surface, std::uint8_t, double a) {
               const bool inside = std::min(p.x(), p.y()) > 1 && std::max(p.x(), p.y()) < 7;
               area += inside ? a : 0;
               horizontal += surface == SurfaceClass::kHorizontal ? 1 : 0;
             });
  EXPECT_GE(horizontal, points.size() * 98 / 100);
  EXPECT_NEAR(area / 36, 1, 0.07);
}

TEST(SurfaceNoise, of_rounded_coordinates_is_not_below_the_rounding) {
  Room room;
  room.noise_m = 0.0005;
  room.corner = Vec3(0, 0, 0);
  std::vector<Vec3> points = room.points();
  for (Vec3& p : points) {
    p = (p * 100).array().round().matrix() / 100;
  }
  const MadeCloud cloud = make_cloud(MemoryScan(points));
  EXPECT_GE(cloud.header.noise_m, 0.01 / std::sqrt(12.0) * 0.999);
  EXPECT_LE(cloud.header.noise_m, 0.006);
  EXPECT_GE(judge(room, cloud, 8 * kDegree).right_class, 0.98);
}

TEST(SurfaceNoise, of_exact_planes_is_small_but_not_zero) {
  Room room;
  room.noise_m = 0;
  const MadeCloud cloud = make_cloud(MemoryScan(room.points()));
  EXPECT_GT(cloud.header.noise_m, 0);
  EXPECT_LT(cloud.header.noise_m, 2e-4);
}

TEST(SurfaceNormals, of_the_file_decide_where_they_are_there) {
  Room room;
  const std::vector<Vec3> points = room.points();
  std::vector<Vec3> normals;
  for (const Vec3& p : points) {
    const int face = room.face_at(p, 0);
    normals.emplace_back(face == 0 ? 1 : 0, face == 1 ? -2 : 0, face == 2 ? 1 : 0);
  }
  std::size_t right = 0;
  for_points(make_cloud(MemoryScan(points, normals)), [&](const Vec3& p, SurfaceClass surface, std::uint8_t,
                                                          double) {
    right += surface == (room.face_at(p, 0) == 2 ? SurfaceClass::kHorizontal : SurfaceClass::kWall) ? 1 : 0;
  });
  EXPECT_EQ(right, points.size()) << "at the edges as well";
}

TEST(SurfaceNormals, of_the_file_are_left_aside_where_they_are_wrong_or_no_directions) {
  Room room;
  const std::vector<Vec3> points = room.points();
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, 0, 0), Vec3(std::nan(""), 0, 1)}) {
    const MadeCloud cloud = make_cloud(MemoryScan(points, std::vector<Vec3>(points.size(), normal)));
    EXPECT_GE(judge(room, cloud, 8 * kDegree).right_class, 0.98) << normal.transpose();
  }
}

}  // namespace
}  // namespace roomcut::testing
