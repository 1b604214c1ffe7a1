// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <limits>

#include "common/artefact/h5.h"
#include "common/artefact/h5_blocks.h"
#include "common/artefact/h5_detail.h"
#include "tests/unit/artefact/temporary_folder.h"

namespace roomcut::test {

namespace {

constexpr ArtefactType kType{"cells", 1, 0};

class H5Damage : public ::testing::Test {
 protected:
  void SetUp() override {
    H5Writer writer(path_, kType, {}, {});
    writer.write<double>("levels/z", std::vector<double>{0, 2.5, 5}, "m", "heights");
    writer.attribute("/", "note", std::string("wall"));
    writer.commit();
  }

  /// Changes the file through the library, as another program might.
  template <class Change>
  void change(Change change) {
    const h5::Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    ASSERT_TRUE(file.valid());
    change(file.get());
  }
  std::string code(std::string* text = nullptr) const {
    return code_of([&] { H5Reader(path_, kType).read<double>("levels/z"); }, text);
  }
  /// Expects damage that is said of `place`.
  void expect_damage(const std::string& place) const {
    std::string text;
    EXPECT_EQ(code(&text), "A02");
    EXPECT_NE(text.find("a.h5: " + place), std::string::npos) << text;
    EXPECT_NE(text.find("make run"), std::string::npos) << text;
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "a.h5";
};

/// A dataset that claims `rows` numbers.
void add_dataset(hid_t file, const char* name, hsize_t rows, hid_t type, hid_t creation) {
  const h5::Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose);
  const h5::Handle made(H5Dcreate2(file, name, type, space.get(), H5P_DEFAULT, creation, H5P_DEFAULT),
                        H5Dclose);
  ASSERT_TRUE(made.valid());
}

}  // namespace

TEST_F(H5Damage, one_changed_number_is_refused_with_the_way_to_make_it_again) {
  change([](hid_t file) {
    const h5::Handle z(H5Dopen2(file, "/levels/z", H5P_DEFAULT), H5Dclose);
    const std::array<double, 3> raised{0, 2.5, 6};
    H5Dwrite(z.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, raised.data());
  });
  std::string text;
  EXPECT_EQ(code(&text), "A02");
  EXPECT_NE(text.find("does not have the digest that it states"), std::string::npos) << text;
  EXPECT_NE(text.find("hint: `make run` makes it again"), std::string::npos) << text;
  EXPECT_EQ(code_of([&] { verified_plain_artefact(path_); }), "A02");
}

TEST_F(H5Damage, what_was_added_or_removed_is_refused) {
  change([](hid_t file) { H5Ldelete(file, "/levels/z", H5P_DEFAULT); });
  EXPECT_EQ(code(), "A02");
  SetUp();
  change([](hid_t file) { add_dataset(file, "more", 3, H5T_IEEE_F64LE, H5P_DEFAULT); });
  EXPECT_EQ(code(), "A02");
  SetUp();
  change([](hid_t file) { h5::write_number_attribute(file, "more", 1.5); });
  EXPECT_EQ(code(), "A02");
  SetUp();
  EXPECT_EQ(code(), "");
}

TEST_F(H5Damage, chunked_compressed_and_external_data_are_refused_before_room_is_made) {
  for (const hsize_t rows : {hsize_t{1000}, hsize_t{1} << 31, hsize_t{1} << 60}) {
    SetUp();
    change([rows](hid_t file) {
      const h5::Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      const hsize_t chunk = 64;
      H5Pset_chunk(creation.get(), 1, &chunk);
      H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER);
      H5Ldelete(file, "/levels/z", H5P_DEFAULT);
      add_dataset(file, "levels/z", rows, H5T_IEEE_F64LE, creation.get());
    });
    expect_damage("/levels/z");
  }
  SetUp();
  put_bytes(folder_ / "elsewhere", std::string(24, 'x'));
  change([this](hid_t file) {
    const h5::Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_external(creation.get(), (folder_ / "elsewhere").c_str(), 0, 24);
    H5Ldelete(file, "/levels/z", H5P_DEFAULT);
    add_dataset(file, "levels/z", 3, H5T_IEEE_F64LE, creation.get());
  });
  expect_damage("/levels/z");
}

TEST_F(H5Damage, a_link_out_of_the_file_is_not_followed) {
  std::filesystem::copy(path_, folder_ / "other.h5");
  change([](hid_t file) {
    H5Ldelete(file, "/levels/z", H5P_DEFAULT);
    H5Lcreate_external("other.h5", "/levels/z", file, "/levels/z", H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_EQ(code(), "A02");
}

TEST_F(H5Damage, numbers_of_other_types_are_not_converted) {
  for (const hid_t type : {H5T_IEEE_F64BE, H5T_IEEE_F32LE, H5T_STD_I64LE, H5T_C_S1}) {
    SetUp();
    change([type](hid_t file) {
      H5Ldelete(file, "/levels/z", H5P_DEFAULT);
      const h5::Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      H5Pset_alloc_time(creation.get(), H5D_ALLOC_TIME_EARLY);
      add_dataset(file, "levels/z", 3, type, creation.get());
    });
    EXPECT_EQ(code(), "A02");
  }
  H5Writer writer(path_, kType, {}, {});
  writer.write<float>("levels/z", std::vector<float>{0, 2.5}, "m", "heights");
  writer.commit();
  expect_damage("/levels/z");
}

TEST_F(H5Damage, an_origin_that_is_not_finite_is_damage_of_the_frame) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1e308}) {
    Frame frame;
    frame.origin[1] = bad;
    H5Writer writer(path_, kType, {}, frame);
    writer.commit();
    expect_damage("/frame");
  }
}

TEST_F(H5Damage, texts_that_are_not_utf8_are_damage) {
  H5Writer writer(path_, kType, {"gra\xff\x80h", 1, "{}", "", {}}, {});
  writer.commit();
  expect_damage("/");
}

TEST_F(H5Damage, parameters_that_were_changed_are_not_believed) {
  H5Writer(path_, kType, {"partition", 1, R"({"a":2})", sha256_hex(R"({"a":1})"), {}}, {}).commit();
  expect_damage("provenance");
}

TEST_F(H5Damage, a_file_that_may_not_be_read_says_so) {
  std::filesystem::permissions(path_, std::filesystem::perms::none);
  const pid_t pid = ::fork();
  if (pid == 0) {
    if (::geteuid() == 0 && ::setuid(65534) != 0) {
      ::_exit(1);
    }
    std::string text;
    const bool missing = code(&text) == "A01";
    ::_exit(missing && text.find("Permission denied") != std::string::npos ? 7 : 8);
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

namespace {

/// 1000 numbers in blocks of 300.
void write_blocks(const std::filesystem::path& path, std::uint64_t second_sum_xor = 0) {
  std::vector<double> values(1000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.5 * static_cast<double>(i);
  std::vector<std::uint64_t> offset{0, 300, 600, 900, 1000};
  std::vector<std::uint64_t> sums;
  for (std::size_t b = 0; b + 1 < offset.size(); ++b) {
    sums.push_back(h5::checksum_of(&values[offset[b]], (offset[b + 1] - offset[b]) * sizeof(double)));
  }
  sums[1] ^= second_sum_xor;
  H5Writer writer(path, kType, {}, {});
  writer.begin<double>("points/x", {1000}, "m", "values", 0);
  writer.append<double>("points/x", values);
  writer.write("points/block_offset", offset, "1", "first rows");
  writer.write<std::uint64_t>("points/checksum", sums, {4, 1}, "1", "sums");
  writer.commit();
}

}  // namespace

TEST_F(H5Damage, checksums_of_blocks_stand_for_the_bytes_and_are_covered_by_the_digest) {
  write_blocks(path_);
  EXPECT_EQ(code_of([&] { verified_plain_artefact(path_); }), "");
  std::string bytes = bytes_of(path_);
  const H5Reader reader(path_, kType);
  const h5::BlockTable table = h5::read_blocks(reader.content(), "points");
  EXPECT_EQ(table.offset, (std::vector<std::uint64_t>{0, 300, 600, 900, 1000}));
  bytes[reader.contiguous_offset("points/x") + 8 * 700] ^= 1;
  put_bytes(folder_ / "b.h5", bytes);
  EXPECT_EQ(code_of([&] { const H5Reader opened(folder_ / "b.h5", kType); }), "")
      << "blocks are checked as read";
  std::string text;
  EXPECT_EQ(code_of([&] { verified_plain_artefact(folder_ / "b.h5"); }, &text), "A02");
  EXPECT_NE(text.find("/points/x: block 2"), std::string::npos) << text;
  write_blocks(path_, 1);
  EXPECT_EQ(code_of([&] { verified_plain_artefact(path_); }, &text), "A02");
  EXPECT_NE(text.find("/points/x: block 1"), std::string::npos) << text;
}

TEST_F(H5Damage, a_checksum_in_pieces_is_that_of_the_whole) {
  const std::string text(100'000, 'a');
  h5::Checksum checksum;
  for (int round = 0; round < 2; ++round) {
    checksum.update(text.data(), 17);
    checksum.update(text.data(), text.size() - 17);
    EXPECT_EQ(checksum.take(), h5::checksum_of(text.data(), text.size()));
  }
}

}  // namespace roomcut::test
