// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "stages/detect_lines/detect_lines.h"
#include "stages/slice/slice.h"
#include "tests/unit/slice/synthetic_cloud.h"

namespace roomcut::detect_lines {
using namespace roomcut::testing;

namespace {

using testing::SyntheticCloud;

Slices two_rooms() {
  SyntheticCloud cloud(0.003);
  cloud.place(0.3, {2, 1});
  cloud.room({0, 0}, {5, 4}, 0, 2.6);
  cloud.room({5.1, 0}, {9, 4}, 0, 2.6);
  return slice::slice_cloud(cloud.header(), cloud.source(), {}).slices;
}

/// How many found lines run within 1 cm and 1 degree of the wall through `middle`.
std::ptrdiff_t lines_at(const WallLines& found, const Vec2& middle, double theta) {
  return std::count_if(found.lines.begin(), found.lines.end(), [&](const WallLine& line) {
    return angle_between(line.line().theta, theta) < 0.0175 && std::abs(line.line().distance(middle)) < 0.01;
  });
}

TEST(Switches, MeanShiftFindsEveryFaceOnceFromTheVotesOfFittedLines) {
  DetectLinesParams params;
  params.search = "mean_shift";
  params.votes = "equal";
  params.vote_window_rad = 0;
  params.wider = false;
  params.min_support_m = 1.5;
  const WallLines found = detect_lines(two_rooms(), params).lines;
  const auto place = [](double x, double y) {
    return Vec2(std::cos(0.3) * x - std::sin(0.3) * y + 2, std::sin(0.3) * x + std::cos(0.3) * y + 1);
  };
  for (const double x : {0.0, 5.0, 5.1, 9.0}) EXPECT_EQ(lines_at(found, place(x, 2), 0.3), 1) << x;
  for (const double y : {0.0, 4.0}) {
    EXPECT_EQ(lines_at(found, place(4.5, y), 0.3 + std::numbers::pi / 2), 1) << y;
  }
}

TEST(Switches, EqualVotesDoNotDependOnHowMuchOfACellIsCovered) {
  Slices slices = two_rooms();
  const auto highest = [&](const char* kind) {
    DetectLinesParams params;
    params.votes = kind;
    const std::vector<float> votes = detect_lines(slices, params).hough.votes_m;
    return *std::max_element(votes.begin(), votes.end());
  };
  const float covered = highest("coverage");
  const float equal = highest("equal");
  for (OccupancyGrid& grid : slices.wall_slices) {
    for (float& weight : grid.weight_m) weight *= 2;
  }
  EXPECT_GT(highest("coverage"), 1.9F * covered);
  EXPECT_EQ(highest("equal"), equal);
}

TEST(Switches, WithoutWiderNeighbourhoodsCornersAreClutter) {
  const Slices slices = two_rooms();
  const auto pieces = [&](bool wider) {
    const WallCells cells = classify_cells(slices, 0.1, wider);
    return std::count(cells.boundary.begin(), cells.boundary.end(), 1);
  };
  EXPECT_LT(pieces(false), pieces(true));
  EXPECT_GT(pieces(false), pieces(true) / 2);
}

}  // namespace
}  // namespace roomcut::detect_lines
