// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/wall_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "common/random/counter_random.h"

namespace roomcut::detect_lines {
namespace {

/// A slice of points as `slice` would hand it over; azimuths are unknown unless given.
Slices grid_of(const std::vector<Vec2>& points, std::uint8_t azimuth = 0, std::uint8_t trust = 0) {
  Slices slices;
  slices.tau_m = 0.04;
  std::map<std::pair<int, int>, Vec2> cells;
  for (const Vec2& p : points) {
    cells[{static_cast<int>(std::floor(p.y() / 0.04)), static_cast<int>(std::floor(p.x() / 0.04))}] = p;
  }
  OccupancyGrid grid;
  for (const auto& [place, p] : cells) {
    grid.iy.push_back(place.first);
    grid.ix.push_back(place.second);
    grid.x.push_back(static_cast<float>(p.x()));
    grid.y.push_back(static_cast<float>(p.y()));
    grid.coverage.push_back(1);
    grid.weight_m.push_back(0.04F);
    grid.area_m2.push_back(0.02F);
    grid.azimuth.push_back(azimuth);
    grid.azimuth_trust.push_back(trust);
  }
  slices.wall_slices = {grid};
  return slices;
}

std::vector<Vec2> wall(double theta, double noise_m) {
  const Line2 line{theta, 1};
  std::vector<Vec2> points;
  for (std::uint64_t i = 0; i < 400; ++i) {
    points.push_back(line.at(0.01 * static_cast<double>(i)) +
                     noise_m * (2 * random_unit(5, 1, i) - 1) * line.normal());
  }
  return points;
}

TEST(ClassifyCells, AWallIsBoundaryInItsDirection) {
  for (const double theta : {0.0, 0.4, 1.2, 2.0, 3.1}) {
    const WallCells cells = classify_cells(grid_of(wall(theta, 0.004)), 0.1);
    std::size_t good = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      good += cells.boundary[i] != 0 && angle_between(static_cast<double>(cells.theta[i]), theta) < 0.12 ? 1U
                                                                                                         : 0U;
    }
    EXPECT_GT(good, 95 * cells.size() / 100) << theta;
  }
}

TEST(ClassifyCells, NoiseOfTwoCentimetresIsOvercomeByALargerNeighbourhood) {
  const WallCells cells = classify_cells(grid_of(wall(0.4, 0.035)), 0.1);  // uniform +-3.5 cm: sigma 2 cm
  std::size_t good = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    good += cells.boundary[i] != 0 && angle_between(static_cast<double>(cells.theta[i]), 0.4) < 0.3 ? 1U : 0U;
  }
  EXPECT_GT(good, 85 * cells.size() / 100);
}

std::vector<Vec2> blob() {
  std::vector<Vec2> points;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    points.emplace_back(2 + 0.8 * random_unit(5, 1, i), 2 + 0.8 * random_unit(5, 2, i));
  }
  return points;
}

TEST(ClassifyCells, ABlobIsClutter) {
  const WallCells cells = classify_cells(grid_of(blob()), 0.1);
  std::size_t boundary = 0;
  for (const std::uint8_t b : cells.boundary) boundary += b;
  EXPECT_LT(boundary, cells.size() / 50);
}

TEST(ClassifyCells, WhereTheNeighbourhoodIsNotLinearTheNormalsDecide) {
  const std::uint8_t step = 100;
  const WallCells trusted = classify_cells(grid_of(blob(), step, 250), 0.1);
  const WallCells mixed = classify_cells(grid_of(blob(), step, 60), 0.1);
  std::size_t of_trusted = 0, of_mixed = 0;
  for (const std::uint8_t b : trusted.boundary) of_trusted += b;
  for (const std::uint8_t b : mixed.boundary) of_mixed += b;
  EXPECT_EQ(of_trusted, trusted.size());
  EXPECT_LT(of_mixed, mixed.size() / 50);
}

TEST(ClassifyCells, EmptySlicesAreFine) {
  Slices slices;
  slices.tau_m = 0.04;
  slices.wall_slices.resize(2);
  EXPECT_EQ(classify_cells(slices, 0.1).size(), 0U);
}

}  // namespace
}  // namespace roomcut::detect_lines
