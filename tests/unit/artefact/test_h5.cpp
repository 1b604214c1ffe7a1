// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/h5.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "tests/unit/artefact/temporary_folder.h"

namespace roomcut::test {

namespace {

constexpr ArtefactType kType{"cells", 1, 0};

Provenance some_provenance() {
  Provenance p{"partition", 3, R"({"a":1})", sha256_hex(R"({"a":1})"), {}};
  p.inputs.push_back({"lines", "wall_lines", "1.0", "cd", "../40_accept_lines/wall_lines.geojson"});
  p.inputs.push_back({"slices", "slices", "1.0", "ef", "../20_slice/slices.h5"});
  return p;
}

Frame some_frame() {
  Frame frame;
  frame.origin[0] = 4.5e6;
  frame.origin[2] = -1.25;
  frame.unit = "mm";
  frame.up = "-y";
  frame.crs = "LOCAL_CS[\"Bauwerk\"]";
  return frame;
}

bool write_sample(const std::filesystem::path& path, double value = 2.5,
                  const std::string& params = R"({"a":1})") {
  Provenance provenance = some_provenance();
  provenance.params_json = params;
  provenance.params_sha256 = sha256_hex(params);
  H5Writer writer(path, kType, provenance, some_frame());
  writer.write<double>("levels/z", {0.0, value, 5.0}, "m", "heights");
  writer.write<std::int32_t>("edges/face", std::vector<std::int32_t>{1, -1, 2, 3}, "1", "faces");
  writer.attribute("levels", "count", std::int64_t{3});
  writer.attribute("/", "note", std::string("größer"));
  writer.attribute("levels/z", "top", 5.0);
  return writer.commit();
}

}  // namespace

TEST(H5, returns_what_was_written) {
  const TemporaryFolder folder;
  EXPECT_TRUE(write_sample(folder / "cells.h5"));
  const H5Reader reader(folder / "cells.h5", kType);
  EXPECT_EQ(reader.read<double>("levels/z"), (std::vector<double>{0.0, 2.5, 5.0}));
  EXPECT_EQ(reader.read<std::int32_t>("/edges/face"), (std::vector<std::int32_t>{1, -1, 2, 3}));
  EXPECT_EQ(reader.attribute_int("levels", "count"), 3);
  EXPECT_EQ(reader.attribute_double("levels/z", "top"), 5.0);
  EXPECT_EQ(reader.attribute_string("/", "note"), "größer");
  EXPECT_EQ(reader.attribute_string("levels/z", "unit"), "m");
  EXPECT_TRUE(reader.exists("levels"));
  EXPECT_FALSE(reader.exists("levels/none"));
  EXPECT_FALSE(reader.exists("none/z"));
}

TEST(H5, keeps_the_coordinate_system_and_counts_it_as_content) {
  const TemporaryFolder folder;
  std::string payload[2];
  for (const std::string crs : {"", "PROJCS[\"größer\"]"}) {
    Frame frame;
    frame.crs = crs;
    H5Writer writer(folder / "cells.h5", kType, some_provenance(), frame);
    writer.write<double>("levels/z", {0.0, 5.0}, "m", "heights");
    writer.commit();
    const H5Reader reader(folder / "cells.h5", kType);
    EXPECT_EQ(reader.frame().crs, crs);
    payload[crs.empty() ? 0 : 1] = inspect_artefact(folder / "cells.h5").payload_sha256;
  }
  EXPECT_NE(payload[0], payload[1]);
}

TEST(H5, keeps_frame_and_provenance) {
  const TemporaryFolder folder;
  write_sample(folder / "cells.h5");
  const H5Reader reader(folder / "cells.h5", kType);
  EXPECT_EQ(reader.frame().origin[0], 4.5e6);
  EXPECT_EQ(reader.frame().origin[2], -1.25);
  EXPECT_EQ(reader.frame().unit, "mm");
  EXPECT_EQ(reader.frame().up, "-y");
  EXPECT_EQ(reader.frame().crs, some_frame().crs);
  EXPECT_EQ(reader.provenance().stage, "partition");
  EXPECT_EQ(reader.provenance().stage_revision, 3);
  EXPECT_EQ(reader.provenance().params_json, R"({"a":1})");
  ASSERT_EQ(reader.provenance().inputs.size(), 2U);
  EXPECT_EQ(reader.provenance().inputs[0].payload_sha256, "cd");
  EXPECT_EQ(reader.provenance().inputs[1].path, "../20_slice/slices.h5");
}

template <class T>
class H5Types : public ::testing::Test {};
using Types = ::testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t,
                               std::uint32_t, std::int64_t, std::uint64_t, float, double>;
TYPED_TEST_SUITE(H5Types, Types);
TYPED_TEST(H5Types, keep_their_extreme_values) {
  using Limits = std::numeric_limits<TypeParam>;
  const TemporaryFolder folder;
  const std::vector<TypeParam> values{Limits::lowest(), TypeParam{1}, Limits::max()};
  H5Writer writer(folder / "a.h5", kType, {}, {});
  writer.write("v", values, "1", "values");
  writer.commit();
  EXPECT_EQ(H5Reader(folder / "a.h5", kType).read<TypeParam>("v"), values);
}

TEST(H5, streams_several_datasets_in_turn) {
  const TemporaryFolder folder;
  constexpr std::uint64_t kRows = 10000;
  H5Writer writer(folder / "a.h5", kType, {}, {});
  writer.begin<float>("points/xyz", {kRows, 3}, "m", "coordinates");
  writer.begin<std::uint8_t>("points/class", {kRows}, "1", "surface class");
  for (std::uint64_t first = 0; first < kRows; first += 777) {
    const std::uint64_t count = std::min<std::uint64_t>(777, kRows - first);
    std::vector<float> xyz;
    std::vector<std::uint8_t> kind;
    for (std::uint64_t i = first; i < first + count; ++i) {
      xyz.insert(xyz.end(), {static_cast<float>(i), static_cast<float>(2 * i), static_cast<float>(3 * i)});
      kind.push_back(static_cast<std::uint8_t>(i % 5));
    }
    writer.append<float>("points/xyz", xyz);
    writer.append<std::uint8_t>("points/class", kind);
  }
  writer.commit();
  const H5Reader reader(folder / "a.h5", kType);
  EXPECT_EQ(reader.shape("points/xyz"), (h5::Shape{kRows, 3}));
  std::vector<float> rows(2UL * 3UL);
  reader.read_rows("points/xyz", 9998, 2, rows.data());
  EXPECT_EQ(rows, (std::vector<float>{9998, 19996, 29994, 9999, 19998, 29997}));
  EXPECT_EQ(reader.read<std::uint8_t>("points/class")[4321], 1);
}

TEST(H5, tells_where_the_bytes_of_a_dataset_lie) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const std::uint64_t at = H5Reader(folder / "a.h5", kType).contiguous_offset("levels/z");
  std::ifstream in(folder / "a.h5", std::ios::binary);
  in.seekg(static_cast<std::streamoff>(at) + 8);
  double value = 0;
  in.read(reinterpret_cast<char*>(&value), sizeof value);  // NOLINT: raw bytes are the subject
  EXPECT_EQ(value, 2.5);
}

TEST(H5, allows_empty_datasets) {
  const TemporaryFolder folder;
  H5Writer writer(folder / "a.h5", kType, {}, {});
  writer.write<double>("none", std::span<const double>(), {0, 3}, "m", "nothing");
  writer.commit();
  const H5Reader reader(folder / "a.h5", kType);
  EXPECT_EQ(reader.shape("none"), (h5::Shape{0, 3}));
  EXPECT_TRUE(reader.read<double>("none").empty());
  EXPECT_EQ(code_of([&] { reader.contiguous_offset("none"); }), "A02");
}

TEST(H5, gives_the_same_bytes_twice) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  ::sleep(1);  // HDF5 counts its object times in seconds
  write_sample(folder / "b.h5");
  EXPECT_EQ(bytes_of(folder / "a.h5"), bytes_of(folder / "b.h5"));
}

TEST(H5, keeps_the_time_stamp_exactly_when_the_payload_is_equal) {
  const TemporaryFolder folder;
  EXPECT_TRUE(write_sample(folder / "a.h5"));
  make_old(folder / "a.h5");
  EXPECT_FALSE(write_sample(folder / "a.h5", 2.5, R"({"a":2})"));
  EXPECT_TRUE(is_old(folder / "a.h5"));
  EXPECT_EQ(H5Reader(folder / "a.h5", kType).provenance().params_json, R"({"a":2})")
      << "provenance must be fresh";
  EXPECT_TRUE(write_sample(folder / "a.h5", 2.6));
  EXPECT_FALSE(is_old(folder / "a.h5"));
}

TEST(H5, payload_digest_covers_names_shapes_types_attributes_and_bytes) {
  const TemporaryFolder folder;
  const std::vector<float> values{1, 2, 3, 4};
  int number = 0;
  const auto digest = [&](const std::string& name, const h5::Shape& shape, const std::string& unit,
                          int kind) {
    const auto path = folder / (std::to_string(number++) + ".h5");
    H5Writer writer(path, kType, {}, {});
    if (kind == 0) {
      writer.write<float>(name, values, shape, unit, "");
    } else {
      const std::vector<std::int32_t> same_bytes{0x3f800000, 0x40000000, 0x40400000, 0x40800000};
      writer.write<std::int32_t>(name, same_bytes, shape, unit, "");
    }
    writer.commit();
    EXPECT_EQ(verified_plain_artefact(path).payload_sha256, H5Reader(path, kType).payload_sha256());
    return H5Reader(path, kType).payload_sha256();
  };
  const std::string base = digest("a", {4}, "m", 0);
  EXPECT_EQ(digest("a", {4}, "m", 0), base);
  EXPECT_NE(digest("b", {4}, "m", 0), base);
  EXPECT_NE(digest("a", {2, 2}, "m", 0), base);
  EXPECT_NE(digest("a", {4}, "rad", 0), base);
  EXPECT_NE(digest("a", {4}, "m", 1), base);
}

TEST(H5, payload_digest_is_found_again_from_the_file_and_shows_a_flipped_bit) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const H5Reader reader(folder / "a.h5", kType);
  EXPECT_EQ(verified_plain_artefact(folder / "a.h5").payload_sha256, reader.payload_sha256());
  std::string bytes = bytes_of(folder / "a.h5");
  bytes[reader.contiguous_offset("levels/z") + 8] ^= 1;
  put_bytes(folder / "b.h5", bytes);
  EXPECT_EQ(code_of([&] { verified_plain_artefact(folder / "b.h5"); }), "A02");
}

TEST(H5, readers_of_the_old_file_are_not_disturbed_by_a_new_one) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5", 2.5);
  const H5Reader reader(folder / "a.h5", kType);
  write_sample(folder / "a.h5", 2.75);
  EXPECT_EQ(reader.read<double>("levels/z")[1], 2.5);
  EXPECT_EQ(H5Reader(folder / "a.h5", kType).read<double>("levels/z")[1], 2.75);
}

}  // namespace roomcut::test
