// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>
#include <map>
#include <tuple>

#include "memory_scan.h"
#include "scan_files.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool same(const CloudTile& a, const CloudTile& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.surface == b.surface && a.azimuth == b.azimuth &&
         a.area == b.area;
}

void expect_same(const MadeCloud& a, const MadeCloud& b) {
  ASSERT_EQ(a.tiles.size(), b.tiles.size());
  for (std::size_t i = 0; i < a.tiles.size(); ++i) {
    EXPECT_TRUE(same(a.tiles[i], b.tiles[i])) << "tile " << i;
  }
  EXPECT_EQ(a.header.noise_m, b.header.noise_m);
  EXPECT_EQ(a.header.density, b.header.density);
  EXPECT_EQ(a.header.tile_offset, b.header.tile_offset);
}

Room big_room() {
  Room room;
  room.size = Vec3(17, 9, 3);
  room.angle = 0.3;
  room.density = 300;
  return room;
}

TEST(TileScan, gives_the_same_for_one_and_two_threads) {
  const MemoryScan scan(big_room().points(), {}, 5'000);
  const MadeCloud many = make_cloud(scan);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  expect_same(many, make_cloud(scan));
}

TEST(TileScan, gives_the_same_from_a_scratch_file_as_from_memory) {
  Room room = big_room();
  const std::vector<Vec3> points = room.points();
  const std::vector<Vec3> normals(points.size(), Vec3(0, 0.6, 0.8));
  for (const bool with_normals : {false, true}) {
    const MemoryScan scan(points, with_normals ? normals : std::vector<Vec3>{}, 5'000);
    ScanSettings settings;
    settings.scratch_folder = std::filesystem::temp_directory_path();
    settings.memory_bytes = 1'000'000;
    const TiledScan spilled = tile_scan(scan, settings, {});
    EXPECT_GT(spilled.store->spilled_bytes(), 500'000U);
    expect_same(make_cloud(scan, settings), make_cloud(scan));
  }
}

/// A tile's points sorted by class, otherwise in their order.
CloudTile by_class(const CloudTile& tile) {
  CloudTile sorted;
  for (std::uint8_t surface = 0; surface < 4; ++surface) {
    for (std::size_t i = 0; i < tile.size(); ++i) {
      if (tile.surface[i] == surface) {
        append({{tile.x[i]}, {tile.y[i]}, {tile.z[i]}, {surface}, {tile.azimuth[i]}, {tile.area[i]}}, sorted);
      }
    }
  }
  return sorted;
}

TEST(TileScan, gives_the_same_from_bands_of_a_tile_as_from_the_whole_but_for_the_order_of_classes) {
  const std::vector<Vec3> points = big_room().points();
  // None, some that contradict the planes, and some that do not: all of a tile's points have a say in that.
  for (const Vec3& normal : {Vec3(0, 0, 0), Vec3(0, 0.6, 0.8), Vec3(0, 0, 1)}) {
    const bool with_normals = normal.norm() > 0;
    const std::vector<Vec3> normals(with_normals ? points.size() : 0, normal);
    const MemoryScan scan(points, normals, 5'000);
    ScanSettings in_bands;
    in_bands.band_points = 500;
    in_bands.memory_bytes = 1'000'000;
    in_bands.scratch_folder = std::filesystem::temp_directory_path();
    MadeCloud bands = make_cloud(scan, in_bands);
    bool in_parts = false;
    for (CloudTile& tile : bands.tiles) {
      in_parts |= !std::is_sorted(tile.surface.begin(), tile.surface.end());
      tile = by_class(tile);
    }
    EXPECT_TRUE(in_parts);
    expect_same(bands, make_cloud(scan));
  }
}

TEST(TileScan, holds_no_more_points_than_a_band_also_where_a_wall_fills_one_row_of_columns) {
  std::vector<Vec3> wall;
  wall.reserve(60'000);
  for (int i = 0; i < 60'000; ++i) {  // 6 m along x, 3 m high, all of it in one row of 5 cm
    wall.emplace_back(0.1 + 6.0 * (i % 3001) / 3001, 0.215 + 0.02 * (i % 7) / 7, 3.0 * (i % 997) / 997);
  }
  ScanSettings in_bands;
  in_bands.band_points = 2'000;
  in_bands.scratch_folder = std::filesystem::temp_directory_path();
  const MadeCloud cloud = make_cloud(MemoryScan(wall), in_bands);
  EXPECT_EQ(cloud.header.points, wall.size());
  EXPECT_LE(cloud.largest_part, 2'000U);
}

TEST(TileScan, holds_every_point_once_in_its_tile_in_order_of_class) {
  const MadeCloud cloud = make_cloud(MemoryScan(big_room().points()));
  EXPECT_EQ(cloud.header.tile_offset.back(), cloud.header.points);
  ASSERT_GT(cloud.tiles.size(), 3U);
  for (std::size_t i = 0; i < cloud.tiles.size(); ++i) {
    const CloudTile& tile = cloud.tiles[i];
    EXPECT_EQ(tile.size(), cloud.header.tile_offset[i + 1] - cloud.header.tile_offset[i]);
    EXPECT_TRUE(std::is_sorted(tile.surface.begin(), tile.surface.end()));
    for (std::size_t k = 0; k < tile.size(); ++k) {
      ASSERT_EQ(std::floor(tile.x[k] / cloud.header.tile_edge_m), cloud.header.tile_ix[i]);
      ASSERT_EQ(std::floor(tile.y[k] / cloud.header.tile_edge_m), cloud.header.tile_iy[i]);
    }
    if (i > 0) {
      EXPECT_LT(std::tie(cloud.header.tile_iy[i - 1], cloud.header.tile_ix[i - 1]),
                std::tie(cloud.header.tile_iy[i], cloud.header.tile_ix[i]));
    }
  }
}

/// Class, azimuth and area by coordinates.
using Found = std::map<std::tuple<float, float, float>, std::tuple<SurfaceClass, int, float>>;

TEST(TileScan, does_not_let_tile_borders_show) {
  // The coordinates are multiples of 1/64 m and the shift one of the coarsest voxel's edge, so that both
  // scans have the same neighbourhoods, the second with other tile borders.
  Room room = big_room();
  std::vector<Vec3> points = room.points();
  for (Vec3& p : points) {
    p = (p * 256).array().round().matrix() / 256;
  }
  IngestParams params;
  params.voxel_edge_m = 0.0625;
  const Vec3 shift(3.5, -1.5, 1.0);
  ScanSettings settings;
  settings.middle = Vec3(0, 0, 0);
  std::vector<Vec3> shifted = points;
  for (Vec3& p : shifted) {
    p += shift;
  }
  const auto collect = [&](const std::vector<Vec3>& from, const Vec3& back) {
    Found found;
    for_points(make_cloud(MemoryScan(from), settings, params),
               [&](const Vec3& p, SurfaceClass surface, int azimuth, double area) {
                 const Eigen::Vector3f key = (p - back).cast<float>();
                 found[{key.x(), key.y(), key.z()}] = {surface, azimuth, static_cast<float>(area)};
               });
    return found;
  };
  EXPECT_EQ(collect(points, Vec3(0, 0, 0)), collect(shifted, shift));
}

TEST(TileScan, works_a_thousand_kilometres_from_the_origin) {
  Room room;
  room.corner = Vec3(1'234'567.5, -4'321'000.25, 830.125);
  const MadeCloud cloud = make_cloud(MemoryScan(room.points()));
  std::size_t right = 0;
  std::size_t clear = 0;
  for_points(cloud, [&](const Vec3& p, SurfaceClass surface, std::uint8_t, double) {
    const int face = room.face_at(p, 0.25);
    clear += face >= 0 ? 1 : 0;
    right += face >= 0 && surface == (face == 2 ? SurfaceClass::kHorizontal : SurfaceClass::kWall) ? 1 : 0;
  });
  EXPECT_GT(clear, 50'000U);
  EXPECT_GE(right, clear * 98 / 100);
  EXPECT_NEAR(cloud.header.noise_m, room.noise_m, 0.1 * room.noise_m);
}

TEST(TileScan, drops_and_counts_bad_points) {
  Room room;
  std::vector<Vec3> points = room.points();
  const std::size_t good = points.size();
  points.insert(points.begin() + 7, Vec3(kNan, 1, 1));
  points.insert(points.begin() + 7, Vec3(1, std::numeric_limits<double>::infinity(), 1));
  for (const Vec3& ghost :
       {Vec3(600, 20, 1), Vec3(-430, -431, 2), Vec3(2, 2, 150), Vec3(1e9, 1, 1), Vec3(1, 1, -1e30)}) {
    points.push_back(ghost);
  }
  ScanSettings settings;
  settings.middle = Vec3(0, 0, 0);  // ghosts move it a little, and with it the voxels
  const MadeCloud cloud = make_cloud(MemoryScan(points), settings);
  EXPECT_EQ(cloud.counts.read, good + 7);
  EXPECT_EQ(cloud.counts.not_finite, 2U);
  EXPECT_EQ(cloud.counts.ghosts, 5U);
  EXPECT_EQ(cloud.counts.kept, good);
  EXPECT_EQ(cloud.header.points, good);
  expect_same(cloud, make_cloud(MemoryScan(room.points()), settings));
}

TEST(TileScan, drops_beams_without_return_also_when_they_are_half_of_a_scan_far_from_the_origin) {
  std::vector<Vec3> points;
  for (const Vec3& point : Room().points()) {
    points.push_back(point + Vec3(836'000, 818'000, 0));
    points.emplace_back(0, 0, 0);
  }
  const MadeCloud cloud = make_cloud(MemoryScan(points));
  EXPECT_EQ(cloud.counts.read, points.size());
  EXPECT_EQ(cloud.counts.no_returns, points.size() / 2);
  EXPECT_EQ(cloud.counts.kept, points.size() / 2);
  EXPECT_EQ(cloud.counts.ghosts, 0U);
  EXPECT_EQ(code_of([] { make_cloud(MemoryScan(std::vector<Vec3>(500, Vec3(0, 0, 0)))); }), "C06");
}

TEST(TileScan, is_not_harmed_by_duplicate_points) {
  Room room;
  std::vector<Vec3> points = room.points();
  points.insert(points.end(), points.begin(),
                points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2));
  double area = 0;
  for_points(make_cloud(MemoryScan(points)),
             [&](const Vec3&, SurfaceClass, std::uint8_t, double a) { area += a; });
  EXPECT_NEAR(area / room.surface(), 1, 0.05);
}

TEST(TileScan, turns_and_scales_as_the_user_says) {
  Room room;
  std::vector<Vec3> points = room.points();
  for (Vec3& p : points) {
    p = Vec3(p.x(), p.z(), -p.y()) * 1000;  // y up, millimetres
  }
  ScanSettings settings;
  settings.unit = "mm";
  settings.up = "y";
  const MadeCloud cloud = make_cloud(MemoryScan(points), settings);
  std::size_t right = 0;
  for_points(cloud, [&](const Vec3& p, SurfaceClass surface, std::uint8_t, double) {
    right += surface == SurfaceClass::kHorizontal && room.face_at(p, 0) == 2 ? 1 : 0;
  });
  EXPECT_GT(right, 50'000U);
  EXPECT_EQ(cloud.header.frame.unit, "mm");
  EXPECT_EQ(cloud.header.frame.up, "y");
}

TEST(TileScan, refuses_scans_without_enough_points) {
  EXPECT_EQ(code_of([] { make_cloud(MemoryScan({Vec3(1, 2, 3)})); }), "C07");
  EXPECT_EQ(code_of([] { make_cloud(MemoryScan(std::vector<Vec3>(500, Vec3(kNan, kNan, kNan)))); }), "C06");
  EXPECT_EQ(code_of([] { make_cloud(MemoryScan({})); }), "C06");
}

TEST(TileScan, refuses_extents_that_only_a_wrong_unit_explains) {
  EXPECT_EQ(code_of([] { make_cloud(MemoryScan(std::vector<Vec3>(500, Vec3(1, 2, 3)))); }), "C09");
  std::vector<Vec3> points = Room{}.points();
  std::vector<Vec3> small = points;
  std::vector<Vec3> wide = points;
  std::vector<Vec3> huge = points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    small[i] *= 0.001;
    wide[i] *= 800;
    huge[i] *= 100'000;
  }
  for (const std::vector<Vec3>& wrong : {small, wide, huge}) {
    std::string text;
    EXPECT_EQ(code_of([&] { make_cloud(MemoryScan(wrong)); }, &text), "C09");
    EXPECT_NE(text.find("--unit"), std::string::npos) << text;
  }
}

/// As if the coordinates had been read from float32 numbers.
class CoarseScan : public MemoryScan {
 public:
  CoarseScan(const std::vector<Vec3>& points, double step) : MemoryScan(points), step_(step) {}
  double resolution(double /*magnitude*/) const override { return step_; }

 private:
  double step_;
};

TEST(TileScan, refuses_coordinates_too_coarse_for_a_model_and_names_their_steps) {
  for (const double step : {0.0625, 0.125, 0.25, 0.5}) {
    std::vector<Vec3> rounded = Room().points();
    for (Vec3& point : rounded) {
      point.x() = std::round(point.x() / step) * step + 5e5;
      point.y() = std::round(point.y() / step) * step + 5.5e6;
    }
    const std::string code = step < 0.1 ? "" : "C10";
    std::string text;
    EXPECT_EQ(code_of([&] { make_cloud(MemoryScan(rounded)); }, &text), code) << step;
    EXPECT_EQ(code_of([&] { make_cloud(CoarseScan(Room().points(), step)); }), code) << step;
    EXPECT_EQ(text.find(std::to_string(std::lround(1000 * step)) + " mm") == std::string::npos, code.empty())
        << text;
  }
}

TEST(TileScan, lets_flat_scans_pass_for_the_stages_that_know_what_is_missing) {
  std::vector<Vec3> floor;
  floor.reserve(10'000);
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < 100; ++column) {
      floor.emplace_back(0.05 * column, 0.05 * row, 0);
    }
  }
  const MadeCloud cloud = make_cloud(MemoryScan(floor));
  std::size_t horizontal = 0;
  for_points(cloud, [&](const Vec3&, SurfaceClass surface, std::uint8_t, double) {
    horizontal += surface == SurfaceClass::kHorizontal ? 1 : 0;
  });
  EXPECT_GT(horizontal, 9'800U);
}

/// A reader whose blocks 3 and 5 cannot be read.
class FaultyScan : public MemoryScan {
 public:
  using MemoryScan::MemoryScan;
  void read(std::size_t index, ScanBlock& block) const override {
    if (index == 3 || index == 5) {
      throw StageError({"C08", ExitCode::kInput}, "block " + std::to_string(index), "is bad");
    }
    MemoryScan::read(index, block);
  }
};

TEST(TileScan, reports_the_first_faulty_block_whatever_thread_comes_first) {
  for (int i = 0; i < 20; ++i) {
    std::string text;
    EXPECT_EQ(code_of([] { make_cloud(FaultyScan(Room{}.points(), {}, 2'000)); }, &text), "C08");
    EXPECT_NE(text.find("block 3"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace roomcut::testing
