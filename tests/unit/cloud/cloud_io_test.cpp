// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cloud/cloud_io.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <limits>
#include <mutex>

#include "common/artefact/h5.h"
#include "common/errors/error.h"

namespace roomcut {
namespace {

class CloudIo : public ::testing::Test {
 protected:
  CloudIo() { std::filesystem::create_directories(folder_); }
  ~CloudIo() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("roomcut_cloud_" + std::to_string(::getpid()));
  std::filesystem::path path_ = folder_ / "cloud.h5";
};

CloudTile tile_of(std::size_t points, float first, float step = 1) {
  CloudTile tile;
  for (std::size_t i = 0; i < points; ++i) {
    const auto value = first + step * static_cast<float>(i);
    tile.x.push_back(value);
    tile.y.push_back(-2 * value);
    tile.z.push_back(0.5F);
    tile.surface.push_back(static_cast<std::uint8_t>(i % 4));
    tile.azimuth.push_back(static_cast<std::uint8_t>(i % 256));
    tile.area.push_back(0.001F * value);
  }
  return tile;
}

CloudHeader header_for(const std::vector<CloudTile>& tiles) {
  CloudHeader header;
  header.frame.origin[0] = 4'500'000;
  header.frame.unit = "cm";
  header.frame.up = "-y";
  header.tile_edge_m = 6.4;
  header.voxel_edge_m = 0.05;
  header.stations = {Vec3(1, 2, 3), Vec3(4, 5, 6.5)};
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    header.points += tiles[i].size();
    header.tile_ix.push_back(static_cast<std::int32_t>(i) - 3);
    header.tile_iy.push_back(static_cast<std::int32_t>(i) + 7);
  }
  return header;
}

void write(const std::filesystem::path& path, const std::vector<CloudTile>& tiles) {
  CloudWriter writer(path, Provenance{"ingest", 1, "{}", "", {}}, header_for(tiles));
  for (const CloudTile& tile : tiles) {
    writer.append(tile);
  }
  writer.header().noise_m = 0.004;
  writer.header().density = 1234.5;
  writer.finish();
}

TEST_F(CloudIo, gives_back_what_was_written) {
  const std::vector<CloudTile> tiles{tile_of(5, 1), tile_of(0, 0), tile_of(1000, 10)};
  write(path_, tiles);
  const CloudReader reader(path_);
  const CloudHeader& header = reader.header();
  EXPECT_EQ(header.points, 1005U);
  EXPECT_EQ(header.frame.origin[0], 4'500'000);
  EXPECT_EQ(header.frame.unit, "cm");
  EXPECT_EQ(header.frame.up, "-y");
  EXPECT_EQ(header.noise_m, 0.004);
  EXPECT_EQ(header.density, 1234.5);
  EXPECT_EQ(header.tile_edge_m, 6.4);
  EXPECT_EQ(header.voxel_edge_m, 0.05);
  EXPECT_EQ(header.tile_ix, (std::vector<std::int32_t>{-3, -2, -1}));
  EXPECT_EQ(header.tile_iy, (std::vector<std::int32_t>{7, 8, 9}));
  EXPECT_EQ(header.tile_offset, (std::vector<std::uint64_t>{0, 5, 5, 1005}));
  EXPECT_EQ(header.bbox_min, Vec3(1, -2018, 0.5));
  EXPECT_EQ(header.bbox_max, Vec3(1009, -2, 0.5));
  ASSERT_EQ(header.stations.size(), 2U);
  EXPECT_EQ(header.stations[1], Vec3(4, 5, 6.5));
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    CloudTile tile;
    reader.read_tile(i, tile);
    EXPECT_EQ(tile.x, tiles[i].x);
    EXPECT_EQ(tile.y, tiles[i].y);
    EXPECT_EQ(tile.z, tiles[i].z);
    EXPECT_EQ(tile.surface, tiles[i].surface);
    EXPECT_EQ(tile.azimuth, tiles[i].azimuth);
    EXPECT_EQ(tile.area, tiles[i].area);
  }
}

TEST_F(CloudIo, visits_every_tile_once) {
  const std::vector<CloudTile> tiles(40, tile_of(100, 1));
  write(path_, tiles);
  std::mutex mutex;
  std::vector<int> visits(40, 0);
  std::uint64_t points = 0;
  CloudReader(path_).for_each_tile(
      [&](std::size_t i, const CloudTile& tile) {
        const std::scoped_lock lock(mutex);
        ++visits[i];
        EXPECT_EQ(tile.size(), 100U);
      },
      [&](std::uint64_t done) {
        const std::scoped_lock lock(mutex);
        points += done;
      });
  EXPECT_EQ(visits, std::vector<int>(40, 1));
  EXPECT_EQ(points, 4000U);
}

TEST_F(CloudIo, visits_a_large_tile_in_parts) {
  const std::vector<CloudTile> tiles{tile_of(200'000, 1, 0.01F), tile_of(10, 2)};
  write(path_, tiles);
  const CloudReader reader(path_);
  std::mutex mutex;
  std::vector<float> heights;
  std::size_t largest = 0;
  reader.for_each_tile([&](std::size_t i, const CloudTile& part) {
    const std::scoped_lock lock(mutex);
    largest = std::max(largest, part.size());
    if (i == 0) heights.insert(heights.end(), part.z.begin(), part.z.end());
  });
  EXPECT_LT(largest, 100'000U);
  std::vector<float> expected = tiles[0].z;
  std::sort(expected.begin(), expected.end());
  std::sort(heights.begin(), heights.end());
  EXPECT_EQ(heights, expected);
  CloudTile part;
  reader.read_part(0, 150'000, 3, part);
  EXPECT_EQ(part.x, std::vector<float>(tiles[0].x.begin() + 150'000, tiles[0].x.begin() + 150'003));
}

TEST_F(CloudIo, writes_equal_clouds_to_equal_bytes) {
  const std::vector<CloudTile> tiles{tile_of(500, 1)};
  write(path_, tiles);
  write(folder_ / "again.h5", tiles);
  const auto bytes = [](const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes(path_), bytes(folder_ / "again.h5"));
  EXPECT_LE(static_cast<double>(std::filesystem::file_size(path_)), 20 * 500 + 20'000);
}

TEST_F(CloudIo, takes_a_tile_in_parts) {
  const std::vector<CloudTile> tiles{tile_of(5, 1), tile_of(2, 6), tile_of(0, 0), tile_of(1000, 10)};
  const std::vector<CloudTile> joined{tile_of(7, 1), tile_of(0, 0), tile_of(1000, 10)};
  CloudHeader header = header_for(joined);
  {
    CloudWriter writer(path_, Provenance{"ingest", 1, "{}", "", {}}, header);
    writer.append(tiles[0], false);
    for (std::size_t i = 1; i < tiles.size(); ++i) {
      writer.append(tiles[i]);
    }
    writer.finish();
  }
  const CloudReader reader(path_);
  EXPECT_EQ(reader.header().tile_offset, (std::vector<std::uint64_t>{0, 7, 7, 1007}));
  CloudTile tile;
  reader.read_tile(0, tile);
  EXPECT_EQ(tile.x, joined[0].x);
}

TEST_F(CloudIo, holds_an_empty_cloud) {
  write(path_, {});
  const CloudReader reader(path_);
  EXPECT_EQ(reader.tiles(), 0U);
  EXPECT_EQ(reader.header().points, 0U);
}

TEST_F(CloudIo, refuses_to_publish_less_than_promised) {
  const std::vector<CloudTile> tiles{tile_of(5, 1), tile_of(5, 1)};
  {
    CloudWriter writer(path_, Provenance{"ingest", 1, "{}", "", {}}, header_for(tiles));
    writer.append(tiles[0]);
    EXPECT_THROW(writer.finish(), std::logic_error);
  }
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(CloudIo, refuses_missing_and_damaged_files) {
  const auto code = [](const std::filesystem::path& path) -> std::string {
    try {
      const CloudReader reader(path);
    } catch (const StageError& error) {
      return error.problems().front().code.id;
    }
    return "";
  };
  EXPECT_EQ(code(folder_ / "absent.h5"), "A01");
  std::ofstream(path_) << "no HDF5 at all";
  EXPECT_EQ(code(path_), "A02");
  write(folder_ / "cut.h5", {tile_of(5000, 1)});
  std::filesystem::resize_file(folder_ / "cut.h5", std::filesystem::file_size(folder_ / "cut.h5") / 2);
  EXPECT_EQ(code(folder_ / "cut.h5"), "A02");
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const StageError& error) {
    return error.what();
  }
  return "";
}

/// Flips a bit of the value `index` of a dataset.
void flip(const std::filesystem::path& path, const char* dataset, std::uint64_t byte) {
  const std::uint64_t at = H5Reader(path, artefacts::kCloud).contiguous_offset(dataset) + byte;
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekg(static_cast<std::streamoff>(at));
  const auto old = static_cast<char>(file.get());
  file.seekp(static_cast<std::streamoff>(at));
  file.put(static_cast<char>(old ^ 1));
}

TEST_F(CloudIo, a_changed_point_is_noticed_when_its_block_is_read_and_not_before) {
  write(path_, {tile_of(100'000, 1, 0.01F), tile_of(10, 2)});
  flip(path_, "points/z", 4 * 70'000);
  const CloudReader reader(path_);
  CloudTile tile;
  EXPECT_NO_THROW(reader.read_part(0, 0, 65'536, tile));
  EXPECT_NO_THROW(reader.read_tile(1, tile));
  const std::string text = error_of([&] { reader.read_part(0, 65'536, 1, tile); });
  EXPECT_NE(text.find("A02"), std::string::npos) << text;
  EXPECT_NE(text.find("/points/z: block 1"), std::string::npos) << text;
  EXPECT_NE(text.find("make run"), std::string::npos) << text;
  EXPECT_NE(error_of([&] { reader.for_each_tile([](std::size_t, const CloudTile&) {}); }), "");
  EXPECT_NE(error_of([&] { verified_plain_artefact(path_); }), "");
}

TEST_F(CloudIo, every_column_is_covered_by_its_checksums) {
  for (const char* column :
       {"points/x", "points/y", "points/z", "points/surface", "points/azimuth", "points/area"}) {
    write(path_, {tile_of(100, 1)});
    EXPECT_EQ(error_of([&] { verified_plain_artefact(path_); }), "");
    flip(path_, column, 40);
    const CloudReader reader(path_);
    CloudTile tile;
    EXPECT_NE(error_of([&] { reader.read_tile(0, tile); }).find(column), std::string::npos) << column;
  }
}

TEST_F(CloudIo, parts_of_any_place_are_cut_from_whole_blocks) {
  const CloudTile whole = tile_of(150'000, 1, 0.01F);
  write(path_, {tile_of(7, 3), whole});
  const CloudReader reader(path_);
  CloudTile part;
  for (const auto& [first, count] : {std::pair{0, 1}, {65'535, 2}, {65'536, 65'536}, {1, 149'999}, {9, 0}}) {
    reader.read_part(1, static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(count), part);
    EXPECT_EQ(part.y, std::vector<float>(whole.y.begin() + first, whole.y.begin() + first + count));
  }
  EXPECT_THROW(reader.read_part(1, 149'999, 2, part), std::out_of_range);
}

/// A cloud as version 1.0 wrote it: without checksums.
void write_old(const std::filesystem::path& path, const CloudTile& tile, double low_z = 0.5) {
  H5Writer file(path, {"cloud", 1, 0}, Provenance{"ingest", 1, "{}", "", {}}, {});
  file.write("points/x", tile.x, "m", "");
  file.write("points/y", tile.y, "m", "");
  file.write("points/z", tile.z, "m", "");
  file.write("points/surface", tile.surface, "1", "");
  file.write("points/azimuth", tile.azimuth, "1", "");
  file.write("points/area", tile.area, "m^2", "");
  file.write("tiles/ix", std::vector<std::int32_t>{0}, "1", "");
  file.write("tiles/iy", std::vector<std::int32_t>{0}, "1", "");
  file.write("tiles/offset", std::vector<std::uint64_t>{0, tile.size()}, "1", "");
  file.write("tiles/edge", std::vector<double>{6.4}, "m", "");
  file.write("cloud/voxel_edge", std::vector<double>{0.05}, "m", "");
  file.write("cloud/bbox_min", std::vector<double>{-300, -300, low_z}, "m", "");
  file.write("cloud/bbox_max", std::vector<double>{300, 300, 1}, "m", "");
  file.write("cloud/noise", std::vector<double>{0.004}, "m", "");
  file.write("cloud/density", std::vector<double>{100}, "1/m^2", "");
  file.write("stations/xyz", std::span<const double>(), {0, 3}, "m", "");
  file.commit();
}

TEST_F(CloudIo, a_cloud_of_version_1_0_is_read_and_checked_as_a_whole_when_opened) {
  const CloudTile old = tile_of(100, 1);
  write_old(path_, old);
  CloudTile tile;
  CloudReader(path_).read_tile(0, tile);
  EXPECT_EQ(tile.x, old.x);
  flip(path_, "points/x", 40);
  EXPECT_NE(error_of([&] { const CloudReader reader(path_); }).find("digest"), std::string::npos);
}

TEST_F(CloudIo, points_that_would_index_outside_the_box_are_damage_whatever_the_checksums) {
  const auto complaint = [&](auto spoil) {
    CloudTile tile = tile_of(100, 1);
    spoil(tile);
    write_old(path_, tile);
    const CloudReader reader(path_);
    return error_of([&] { reader.read_tile(0, tile); });
  };
  EXPECT_EQ(complaint([](CloudTile&) {}), "");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(complaint([nan](CloudTile& t) { t.x[57] = nan; }).find("points/x"), std::string::npos);
  EXPECT_NE(complaint([](CloudTile& t) { t.y[3] = 1e30F; }).find("points/y"), std::string::npos);
  EXPECT_NE(complaint([](CloudTile& t) { t.z[99] = -7; }).find("points/z"), std::string::npos);
  EXPECT_NE(complaint([](CloudTile& t) { t.surface[0] = 200; }).find("points/surface"), std::string::npos);
  EXPECT_NE(complaint([nan](CloudTile& t) { t.area[8] = nan; }).find("points/area"), std::string::npos);
}

TEST_F(CloudIo, a_header_that_no_scan_has_is_damage) {
  const auto complaint = [&](auto spoil) {
    const std::vector<CloudTile> tiles{tile_of(5, 1), tile_of(5, 1)};
    CloudHeader header = header_for(tiles);
    spoil(header);
    {
      CloudWriter writer(path_, Provenance{"ingest", 1, "{}", "", {}}, header);
      for (const CloudTile& tile : tiles) writer.append(tile);
      writer.header().noise_m = header.noise_m;
      writer.finish();
    }
    return error_of([&] { const CloudReader reader(path_); });
  };
  EXPECT_EQ(complaint([](CloudHeader&) {}), "");
  EXPECT_NE(complaint([](CloudHeader& h) { std::swap(h.tile_iy[0], h.tile_iy[1]); }).find("tiles/iy"),
            std::string::npos);
  EXPECT_NE(complaint([](CloudHeader& h) { h.tile_ix[0] = INT32_MIN; }).find("tiles/ix"), std::string::npos);
  EXPECT_NE(complaint([](CloudHeader& h) { h.tile_edge_m = 1e-30; }).find("tiles/edge"), std::string::npos);
  EXPECT_NE(complaint([](CloudHeader& h) { h.noise_m = -1; }).find("cloud/noise"), std::string::npos);
  EXPECT_NE(complaint([](CloudHeader& h) { h.stations[0].x() = 1e300; }).find("stations/xyz"),
            std::string::npos);
  write_old(path_, tile_of(5, 1), 2e5);
  EXPECT_NE(error_of([&] { const CloudReader reader(path_); }).find("cloud/bbox_min"), std::string::npos);
}

}  // namespace
}  // namespace roomcut
