// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/detect_lines.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "common/errors/error.h"
#include "stages/slice/slice.h"
#include "tests/unit/slice/synthetic_cloud.h"

namespace roomcut::detect_lines {
using namespace roomcut::slice;
using namespace roomcut::testing;

namespace {

using testing::SyntheticCloud;

constexpr double kDegree = std::numbers::pi / 180;

Slices slices_of(const SyntheticCloud& cloud) {
  return slice_cloud(cloud.header(), cloud.source(), {}).slices;
}

/// Twelve rooms of different sizes in 4 columns and 3 rows, walls 10 cm thick.
void twelve_rooms(SyntheticCloud& cloud) {
  const double wall = 0.10;
  const std::vector<double> x = {0, 4.2, 7.3, 12.1, 15.0};
  const std::vector<double> y = {0, 3.4, 5.2, 9.9};
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      cloud.room({x[i] + wall / 2, y[j] + wall / 2}, {x[i + 1] - wall / 2, y[j + 1] - wall / 2}, 0, 2.6);
    }
  }
}

/// Length of the true walls that a found line follows within the limits, over their whole length.
double recall(const SyntheticCloud& cloud, const WallLines& found, double distance_m, double angle_rad) {
  double total = 0, hit = 0;
  for (const auto& [a, b] : cloud.true_walls()) {
    const double theta = line_through(a, b).theta;
    total += (b - a).norm();
    for (const WallLine& line : found.lines) {
      const Line2 candidate = line.line();
      const double middle = candidate.along(0.5 * (a + b));
      const auto [t0, t1] = std::minmax({candidate.along(line.a), candidate.along(line.b)});
      if (angle_between(candidate.theta, theta) < angle_rad &&
          std::abs(candidate.distance(0.5 * (a + b))) < distance_m && t0 < middle && middle < t1) {
        hit += (b - a).norm();
        break;
      }
    }
  }
  return hit / total;
}

/// Found lines that follow no true wall.
int spurious(const SyntheticCloud& cloud, const WallLines& found) {
  int count = 0;
  for (const WallLine& line : found.lines) {
    const bool real =
        std::any_of(cloud.true_walls().begin(), cloud.true_walls().end(), [&](const auto& wall) {
          const Line2 truth = line_through(wall.first, wall.second);
          return angle_between(truth.theta, line.line().theta) < 1.5 * kDegree &&
                 std::abs(truth.distance(line.centre())) < 0.03;
        });
    count += real ? 0 : 1;
  }
  return count;
}

TEST(DetectLines, ARoofThatIsPlanesGivesNoLines) {
  SyntheticCloud cloud(0.004, 600);
  cloud.horizontal({0, 0}, {8, 9}, 0.0);
  cloud.surface(
      {0, 0}, {8, 9}, [](const Vec2& p) { return 6.5 - std::abs(p.y() - 4.5); }, SurfaceClass::kSloped);
  for (const double y : {0.0, 9.0}) cloud.wall({0, y}, {8, y}, 0, 2);
  const Slices slices = slices_of(cloud);
  EXPECT_EQ(slices.planes.size(), 2U);
  for (const WallLine& line : detect_lines(slices, {}).lines.lines) {
    EXPECT_LT(std::min(std::abs(line.centre().y()), std::abs(line.centre().y() - 9)), 0.02);
  }
}

TEST(DetectLines, ContoursOfARoofThatNoPlaneExplainsAreLinesOfItsSlicesOnly) {
  SyntheticCloud cloud(0.004, 600);
  cloud.horizontal({0, 0}, {8, 9}, 0.0);
  const auto corrugated = [](const Vec2& p) {
    return 6.5 - std::abs(p.y() - 4.5) + 0.15 * std::sin(4 * std::numbers::pi * p.y());
  };
  cloud.surface({0, 0}, {8, 9}, corrugated, SurfaceClass::kSloped);
  for (const double y : {0.0, 9.0}) cloud.wall({0, y}, {8, y}, 0, 2);
  const Slices slices = slices_of(cloud);
  std::size_t contours = 0;
  for (const WallLine& line : detect_lines(slices, {}).lines.lines) {
    const double y = line.centre().y();
    if (std::abs(y) < 0.02 || std::abs(y - 9) < 0.02) {
      EXPECT_TRUE(!line.levels || line.levels->front() == 0) << "an outer wall stands below the eaves";
      continue;
    }
    ASSERT_TRUE(line.levels) << y;
    ++contours;
    for (const int k : *line.levels) {
      const double roof = corrugated({0, y});  // in the slice: its foot in the upper end of the lowest one
      EXPECT_GT(roof, slices.levels[static_cast<std::size_t>(k)].z - 0.15);
      EXPECT_LT(roof, slices.levels[static_cast<std::size_t>(k) + 1].z + 0.15);
    }
  }
  EXPECT_GE(contours, 10U);
}

TEST(DetectLines, WallsOfTwoStoreysThreeCentimetresApartStayTwoLines) {
  SyntheticCloud cloud(0.004);
  cloud.room({0, 0}, {6, 5}, 0, 2.6);
  cloud.room({0, 0}, {6.03, 5}, 2.9, 5.5);
  const WallLines found = detect_lines(slices_of(cloud), {}).lines;
  const auto at = [&](double x) {
    return std::count_if(found.lines.begin(), found.lines.end(), [&](const WallLine& line) {
      return std::abs(line.line().distance({x, 2.5})) < 0.006 && std::abs(line.centre().y() - 2.5) < 0.2;
    });
  };
  EXPECT_EQ(at(6.0), 1);
  EXPECT_EQ(at(6.03), 1);
}

TEST(DetectLines, EveryWallOfTwelveRoomsIsFoundAndNothingElse) {
  for (const double angle : {0.0, 20.0, 45.0, 77.7}) {
    SyntheticCloud cloud(0.005);
    cloud.place(angle * kDegree, {3, -2});
    twelve_rooms(cloud);
    const DetectLinesResult result = detect_lines(slices_of(cloud), {});
    EXPECT_EQ(recall(cloud, result.lines, 0.01, 0.3 * kDegree), 1.0) << angle;
    EXPECT_EQ(spurious(cloud, result.lines), 0) << angle;
    EXPECT_LE(result.lines.lines.size(), 16U) << angle;  // 14 faces across the building, gaps may part some
  }
}

TEST(DetectLines, NoiseOfOneAndTwoCentimetres) {
  for (const double noise : {0.01, 0.02}) {
    SyntheticCloud cloud(noise);
    cloud.place(20 * kDegree, {0, 0});
    twelve_rooms(cloud);
    const DetectLinesResult result = detect_lines(slices_of(cloud), {});
    EXPECT_EQ(recall(cloud, result.lines, 0.02, 1.0 * kDegree), 1.0) << noise;
    EXPECT_LE(spurious(cloud, result.lines), 1) << noise;
  }
}

TEST(DetectLines, AnisotropicDensity) {
  SyntheticCloud cloud(0.005, 3000);
  cloud.place(20 * kDegree, {0, 0});
  cloud.thin([](const Vec2& p) { return std::max(0.02, 1 / (1 + 0.25 * (p - Vec2(6, 4)).squaredNorm())); });
  twelve_rooms(cloud);
  const DetectLinesResult result = detect_lines(slices_of(cloud), {});
  EXPECT_EQ(recall(cloud, result.lines, 0.01, 0.3 * kDegree), 1.0);
  EXPECT_EQ(spurious(cloud, result.lines), 0);
}

TEST(DetectLines, ASparseScanOfHundredPointsPerSquareMetre) {
  SyntheticCloud cloud(0.005, 100);
  cloud.place(20 * kDegree, {0, 0});
  twelve_rooms(cloud);
  const DetectLinesResult result = detect_lines(slices_of(cloud), {});
  EXPECT_GE(recall(cloud, result.lines, 0.02, 1.0 * kDegree), 0.97);
  EXPECT_LE(spurious(cloud, result.lines), 1);
}

TEST(DetectLines, BothFacesOfThinWallsStay) {
  for (const double thickness : {0.08, 0.10, 0.12}) {
    for (const double noise : {0.003, 0.01}) {
      SyntheticCloud cloud(noise, 800);
      cloud.place(33 * kDegree, {0, 0});
      cloud.room({0, 0}, {5, 4}, 0, 2.6);
      cloud.room({5 + thickness, 0}, {9, 4}, 0, 2.6);
      const DetectLinesResult result = detect_lines(slices_of(cloud), {});
      EXPECT_EQ(recall(cloud, result.lines, 0.01, 0.5 * kDegree), 1.0) << thickness << " " << noise;
      EXPECT_EQ(spurious(cloud, result.lines), 0) << thickness << " " << noise;
    }
  }
}

TEST(DetectLines, AnObliqueWallIsFound) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {8, 6}, 0, 2.6);
  cloud.wall({8, 2}, {4, 6}, 0, 2.6);
  cloud.wall({1, 6}, {0, 5.2}, 0, 2.6);
  const DetectLinesResult result = detect_lines(slices_of(cloud), {});
  EXPECT_EQ(result.lines.lines.size(), 6U);
}

TEST(DetectLines, AQuarterCircleBecomesChords) {
  SyntheticCloud cloud(0.004, 800);
  cloud.horizontal({0, 0}, {5, 5}, 0.0);
  cloud.horizontal({0, 0}, {5, 5}, 2.6);
  constexpr int kPieces = 90;
  const double radius = 3;
  for (int i = 0; i < kPieces; ++i) {
    const double from = 0.5 * std::numbers::pi * i / kPieces;
    const double to = 0.5 * std::numbers::pi * (i + 1) / kPieces;
    cloud.wall(radius * Vec2(std::cos(from), std::sin(from)), radius * Vec2(std::cos(to), std::sin(to)), 0,
               2.6);
  }
  const DetectLinesResult result = detect_lines(slices_of(cloud), {});
  EXPECT_EQ(result.arcs, 1U);
  EXPECT_GE(result.lines.lines.size(), 12U);
  EXPECT_LE(result.lines.lines.size(), 16U);
  double covered = 0;
  for (const WallLine& line : result.lines.lines) {
    covered += line.support_m;
    EXPECT_NEAR(std::abs(line.line().d), radius, 0.006);  // a chord of 35 cm sags 5 mm
  }
  EXPECT_GT(covered, 0.85 * 0.5 * std::numbers::pi * radius);
}

TEST(DetectLines, CabinetsBelowTheCeilingGiveNoLine) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {8, 6}, 0, 2.6);
  cloud.wall({2, 0.6}, {5, 0.6}, 0, 1.9);
  cloud.wall({2, 0}, {2, 0.6}, 0, 1.9);
  cloud.horizontal({2, 0}, {5, 0.6}, 1.9);
  const DetectLinesResult result = detect_lines(slices_of(cloud), {});
  EXPECT_EQ(result.lines.lines.size(), 4U);
}

TEST(DetectLines, ClutterIsMarkedAndDoesNotVote) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {8, 6}, 0, 2.6);
  for (int i = 0; i < 300; ++i) {  // a plant that reaches the ceiling: short twigs in all directions
    const Vec2 at(4 + 0.8 * random_unit(7, 1, static_cast<std::uint64_t>(i)),
                  3 + 0.8 * random_unit(7, 2, static_cast<std::uint64_t>(i)));
    const double turn = 6.28 * random_unit(7, 3, static_cast<std::uint64_t>(i));
    cloud.wall(at, at + 0.05 * Vec2(std::cos(turn), std::sin(turn)), 2.0, 2.6, SurfaceClass::kNone);
  }
  const DetectLinesResult result = detect_lines(slices_of(cloud), {});
  EXPECT_EQ(result.lines.lines.size(), 4U);
}

TEST(DetectLines, SupportsFarApartOnOneLineAreLinesOfTheirOwn) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {20, 6}, 0, 2.6);
  cloud.wall({4, 3}, {6, 3}, 0, 2.6);
  cloud.wall({14, 3}, {16, 3}, 0, 2.6);
  const DetectLinesResult result = detect_lines(slices_of(cloud), {});
  EXPECT_EQ(result.lines.lines.size(), 6U);
}

TEST(DetectLines, ADoorDoesNotPartAWall) {
  SyntheticCloud cloud;
  cloud.room({0, 0}, {8, 6}, 0, 2.6);
  cloud.wall({4, 0}, {4, 2.5}, 0, 2.6);
  cloud.wall({4, 3.5}, {4, 6}, 0, 2.6);
  const DetectLinesResult result = detect_lines(slices_of(cloud), {});
  ASSERT_EQ(result.lines.lines.size(), 5U);
  const auto parted = std::find_if(result.lines.lines.begin(), result.lines.lines.end(),
                                   [](const WallLine& line) { return std::abs(line.a.x() - 4) < 0.02; });
  ASSERT_NE(parted, result.lines.lines.end());
  EXPECT_NEAR(parted->length(), 6, 0.2);  // corner cells go to the crossing wall
  EXPECT_NEAR(parted->support_m, 5, 0.3);
}

/// Support of the wall that stands alone in a room which has been turned and moved against the grids; the
/// upper half of what counts of its height was seen.
struct Turned {
  double support_m = 0, angle_step_deg = 0;
};

Turned half_seen_wall(double angle_rad, const Vec2& shift, double density) {
  SyntheticCloud cloud(0.004, density);
  cloud.place(angle_rad, shift);
  cloud.room({0, 0}, {9, 4}, 0, 2.6);
  cloud.wall({3, 2}, {6, 2}, 2.27, 2.58);
  const DetectLinesResult result = detect_lines(slices_of(cloud), {});
  Turned turned;
  for (const DetectLinesChoice& choice : result.choices) {
    if (choice.parameter == "hough_angle_deg") turned.angle_step_deg = choice.value;
  }
  const Line2 truth{angle_rad + 0.5 * std::numbers::pi, 0};
  for (const WallLine& line : result.lines.lines) {
    if (line.length() < 3.5 && angle_between(line.line().theta, truth.theta) < 0.02) {
      turned.support_m = std::max(turned.support_m, line.support_m);
    }
  }
  return turned;
}

TEST(DetectLines, AWallHasTheSameSupportHoweverTheGridsLie) {
  const Turned still = half_seen_wall(0, {0, 0}, 600);
  EXPECT_NEAR(still.support_m, 1.5, 0.15);
  for (const double angle : {0.0, 0.3, 0.25 * std::numbers::pi, 0.5 * std::numbers::pi}) {
    for (const Vec2& shift : {Vec2(0, 0.02), Vec2(0.013, 0.031)}) {
      const Turned turned = half_seen_wall(angle, shift, 600);
      EXPECT_NEAR(turned.support_m, still.support_m, 0.12) << angle << ", " << shift.y();
      EXPECT_EQ(turned.angle_step_deg, still.angle_step_deg) << angle;
    }
  }
}

TEST(DetectLines, AWallHasNearlyTheSameSupportInAThinnedScan) {
  const double dense = half_seen_wall(0, {0, 0.01}, 1600).support_m;
  EXPECT_NEAR(half_seen_wall(0, {0, 0.01}, 400).support_m, dense, 0.1 * dense);
  EXPECT_NEAR(half_seen_wall(0, {0, 0.01}, 200).support_m, dense, 0.15 * dense);
}

TEST(DetectLines, UncertaintyGrowsWithNoiseAndShrinksWithLength) {
  SyntheticCloud quiet(0.002), loud(0.01);
  quiet.room({0, 0}, {8, 3}, 0, 2.6);
  loud.room({0, 0}, {8, 3}, 0, 2.6);
  const DetectLinesResult a = detect_lines(slices_of(quiet), {});
  const DetectLinesResult b = detect_lines(slices_of(loud), {});
  ASSERT_EQ(a.lines.lines.size(), 4U);
  ASSERT_EQ(b.lines.lines.size(), 4U);
  EXPECT_LT(a.lines.lines[0].sigma_offset_m, b.lines.lines[0].sigma_offset_m);
  EXPECT_LT(b.lines.lines[0].sigma_angle_rad, b.lines.lines[3].sigma_angle_rad);  // 8 m against 3 m
  EXPECT_GT(a.lines.lines[0].sigma_offset_m, 0);
}

TEST(DetectLines, StrongerLinesHaveLowerIds) {
  SyntheticCloud cloud;
  twelve_rooms(cloud);
  const DetectLinesResult result = detect_lines(slices_of(cloud), {});
  for (std::size_t i = 1; i < result.lines.lines.size(); ++i) {
    EXPECT_LT(result.lines.lines[i - 1].id, result.lines.lines[i].id);
    EXPECT_GE(result.lines.lines[i - 1].support_m, result.lines.lines[i].support_m);
  }
}

TEST(DetectLines, AnyNumberOfThreadsGivesTheSameLines) {
  SyntheticCloud cloud(0.01);
  cloud.place(0.3, {0, 0});
  twelve_rooms(cloud);
  const Slices slices = slices_of(cloud);
  std::vector<DetectLinesResult> results;
  for (const std::size_t threads : {1, 2, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(detect_lines(slices, {}));
  }
  for (const DetectLinesResult& result : results) {
    ASSERT_EQ(result.lines.lines.size(), results[0].lines.lines.size());
    for (std::size_t i = 0; i < result.lines.lines.size(); ++i) {
      EXPECT_EQ(result.lines.lines[i].a, results[0].lines.lines[i].a);
      EXPECT_EQ(result.lines.lines[i].b, results[0].lines.lines[i].b);
    }
  }
}

TEST(DetectLines, TheOutermostCellDoesNotMoveTheAccumulator) {
  SyntheticCloud cloud;
  twelve_rooms(cloud);
  Slices slices = slices_of(cloud);
  const HoughPicture before = detect_lines(slices, {}).hough;
  OccupancyGrid& grid = slices.wall_slices.front();
  const auto last = static_cast<std::size_t>(std::max_element(grid.x.begin(), grid.x.end()) - grid.x.begin());
  grid.x[last] += 0.012F;
  const HoughPicture after = detect_lines(slices, {}).hough;
  EXPECT_LT((before.centre - after.centre).norm(), 1e-4);
  EXPECT_EQ(before.angle_step, after.angle_step);
  EXPECT_EQ(before.distance0, after.distance0);
}

TEST(DetectLines, SlicesWithoutCellsAreErrorN03) {
  Slices slices;
  slices.tau_m = 0.04;
  slices.levels = {{0, 0, 0, 10, 10, false}, {2.5, 2.5, 2.5, 10, 10, false}};
  slices.wall_slices.resize(1);
  try {
    detect_lines(slices, {});
    FAIL() << "no error";
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems().front().code.id, "N03");
  }
}

}  // namespace
}  // namespace roomcut::detect_lines
