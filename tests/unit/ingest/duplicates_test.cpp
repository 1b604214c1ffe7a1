// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

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

/// The points, and the first ones of them once more.
MadeCloud with_copies(double share, const ScanSettings& settings = {}) {
  std::vector<Vec3> points = room_points();
  const std::size_t own = points.size();
  for (std::size_t i = 0; i < static_cast<std::size_t>(share * static_cast<double>(own)); ++i) {
    points.push_back(points[i * 7919 % own]);
  }
  return make_cloud(MemoryScan(points), settings);
}

TEST(Duplicates, are_none_in_a_scan_that_has_none) {
  EXPECT_EQ(with_copies(0).duplicates, 0U);
}

TEST(Duplicates, of_a_file_written_twice_over_are_half_of_the_points) {
  const MadeCloud cloud = with_copies(1);
  EXPECT_EQ(2 * cloud.duplicates, cloud.counts.kept);
}

TEST(Duplicates, are_counted_exactly_where_they_are_more_than_a_few) {
  EXPECT_EQ(with_copies(0.1).duplicates, with_copies(0.1).counts.kept - room_points().size());
}

TEST(Duplicates, in_bands_of_a_large_tile_are_the_same) {
  ScanSettings bands;
  bands.band_points = 1000;
  bands.scratch_folder = std::filesystem::temp_directory_path();
  EXPECT_EQ(with_copies(1, bands).duplicates, with_copies(1).duplicates);
}

TEST(Duplicates, are_not_points_that_differ_by_a_millimetre) {
  std::vector<Vec3> points = room_points();
  const std::size_t own = points.size();
  for (std::size_t i = 0; i < own; ++i) {
    points.emplace_back(points[i] + Vec3(0.001, 0, 0));
  }
  EXPECT_EQ(make_cloud(MemoryScan(points)).duplicates, 0U);
}

}  // namespace
}  // namespace roomcut::testing
