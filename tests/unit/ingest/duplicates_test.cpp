// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/duplicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "memory_scan.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

std::vector<Vec3> room_points() {
  Room room;
  room.size = Vec3(17, 9, 3);
  room.density = 300;
  return room.points();
}

/// The points, and the first ones of them `copies` times more.
MadeCloud with_copies(double copies, const ScanSettings& settings = {}) {
  std::vector<Vec3> points = room_points();
  const std::size_t own = points.size();
  for (std::size_t i = 0; i < static_cast<std::size_t>(copies * static_cast<double>(own)); ++i) {
    points.push_back(points[i * 7919 % own]);
  }
  return make_cloud(MemoryScan(points), settings);
}

/// x, y, z, class, area of the points of a tile, whatever their order: it follows the bands.
std::vector<std::array<float, 5>> sorted_points(const CloudTile& tile) {
  std::vector<std::array<float, 5>> points;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    points.push_back({tile.x[i], tile.y[i], tile.z[i], static_cast<float>(tile.surface[i]), tile.area[i]});
  }
  std::sort(points.begin(), points.end());
  return points;
}

void expect_same(const MadeCloud& a, const MadeCloud& b) {
  ASSERT_EQ(a.tiles.size(), b.tiles.size());
  for (std::size_t i = 0; i < a.tiles.size(); ++i) {
    EXPECT_TRUE(sorted_points(a.tiles[i]) == sorted_points(b.tiles[i])) << "tile " << i;
  }
  EXPECT_EQ(a.header.tile_offset, b.header.tile_offset);
  EXPECT_EQ(a.header.noise_m, b.header.noise_m);
  EXPECT_EQ(a.header.density, b.header.density);
}

ScanSettings in_bands() {
  ScanSettings settings;
  settings.band_points = 1000;
  settings.scratch_folder = std::filesystem::temp_directory_path();
  return settings;
}

TEST(Duplicates, are_none_in_a_scan_that_has_none) {
  EXPECT_EQ(with_copies(0).counts.duplicates, 0U);
}

TEST(Duplicates, of_a_file_written_twice_over_leave_the_cloud_as_it_is) {
  const MadeCloud twice = with_copies(1);
  EXPECT_EQ(twice.counts.duplicates, room_points().size());
  EXPECT_EQ(twice.header.points, room_points().size());
  expect_same(twice, with_copies(0));
}

TEST(Duplicates, of_a_tenth_of_the_points_are_dropped_every_one) {
  const MadeCloud some = with_copies(0.1);
  EXPECT_EQ(some.counts.duplicates, room_points().size() / 10);
  EXPECT_EQ(some.counts.kept, room_points().size());
}

TEST(Duplicates, in_bands_of_a_large_tile_leave_the_cloud_as_it_is) {
  const MadeCloud twice = with_copies(1, in_bands());
  EXPECT_EQ(twice.counts.duplicates, room_points().size());
  expect_same(twice, with_copies(0, in_bands()));
}

TEST(Duplicates, are_not_points_that_differ_by_a_millimetre) {
  std::vector<Vec3> points = room_points();
  const std::size_t own = points.size();
  for (std::size_t i = 0; i < own; ++i) {
    points.emplace_back(points[i] + Vec3(0.001, 0, 0));
  }
  EXPECT_EQ(make_cloud(MemoryScan(points)).counts.duplicates, 0U);
}

LocalPoints some_points(int first, int last) {
  LocalPoints points;
  for (int i = first; i < last; ++i) {
    points.x.push_back(static_cast<float>(i % 997) * 0.01F);
    points.y.push_back(static_cast<float>(i / 997 % 991) * 0.01F);
    points.z.push_back(static_cast<float>(i % 3));
  }
  return points;
}

TEST(DuplicateSample, of_many_points_says_the_share_to_a_hundredth) {
  DuplicateSample sample;
  sample.add(some_points(0, 800'000));
  EXPECT_EQ(sample.share(), 0);
  sample.add(some_points(0, 200'000));
  EXPECT_NEAR(sample.share(), 0.2, 0.01);
}

TEST(DuplicateSample, says_the_same_however_the_points_are_spread_over_threads) {
  DuplicateSample one;
  one.add(some_points(0, 700'000));
  one.add(some_points(0, 100'000));
  DuplicateSample first;
  DuplicateSample second;
  first.add(some_points(0, 100'000));
  second.add(some_points(0, 500'000));
  first.add(some_points(500'000, 700'000));
  first.add(second);
  EXPECT_EQ(one.share(), first.share());
  EXPECT_GT(one.share(), 0.1);
}

}  // namespace
}  // namespace roomcut::testing
