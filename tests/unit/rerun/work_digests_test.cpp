// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/rerun/work_digests.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "common/artefact/sha256.h"
#include "tests/unit/rerun/work_folder.h"

namespace roomcut::test {
namespace {

/// Digests with a count of how often a payload was read.
struct Counted {
  int reads = 0;
  WorkDigests digests{[this](const std::filesystem::path& path) {
                        ++reads;
                        return "payload-" + bytes_of(path);
                      },
                      "outside.ply", 0};
};

/// So that the file system's clock, which may go in steps of 10 ms, moves on.
void wait_a_tick() {
  std::this_thread::sleep_for(std::chrono::milliseconds(25));
}

std::string read_and_save(int* reads = nullptr) {
  Counted counted;
  const std::string digest = counted.digests.of("a.h5");
  counted.digests.save();
  if (reads != nullptr) {
    *reads = counted.reads;
  }
  return digest;
}

TEST(WorkDigests, a_file_is_read_once_as_long_as_it_stays_as_it_is) {
  const WorkFolder folder;
  put_bytes("a.h5", "1");
  wait_a_tick();
  int reads = 0;
  EXPECT_EQ(read_and_save(&reads), "payload-1");
  EXPECT_EQ(reads, 1);
  EXPECT_EQ(read_and_save(&reads), "payload-1");
  EXPECT_EQ(reads, 0);
}

TEST(WorkDigests, a_change_in_place_is_seen_although_size_and_time_are_put_back) {
  const WorkFolder folder;
  put_bytes("a.h5", "1");
  make_old("a.h5");
  wait_a_tick();
  EXPECT_EQ(read_and_save(), "payload-1");
  put_bytes("a.h5", "2");
  make_old("a.h5");
  EXPECT_EQ(read_and_save(), "payload-2");
}

TEST(WorkDigests, a_change_within_the_tick_of_the_first_look_is_seen) {
  const WorkFolder folder;
  for (int i = 0; i < 200; ++i) {
    const std::string before = "1" + std::to_string(100 + i);
    const std::string after = "2" + std::to_string(100 + i);
    put_bytes("a.h5", before);
    EXPECT_EQ(read_and_save(), "payload-" + before);
    put_bytes("a.h5", after);  // the same file, the same size, mostly the same tick
    EXPECT_EQ(read_and_save(), "payload-" + after);
  }
}

TEST(WorkDigests, a_touched_or_copied_file_is_read_again) {
  const WorkFolder folder;
  put_bytes("a.h5", "1");
  wait_a_tick();
  read_and_save();
  make_old("a.h5");
  int reads = 0;
  EXPECT_EQ(read_and_save(&reads), "payload-1");
  EXPECT_EQ(reads, 1);
  std::filesystem::copy_file("a.h5", "b.h5");
  std::filesystem::rename("b.h5", "a.h5");
  EXPECT_EQ(read_and_save(&reads), "payload-1");
  EXPECT_EQ(reads, 1);
}

TEST(WorkDigests, what_enters_from_outside_goes_by_its_bytes) {
  const WorkFolder folder;
  std::filesystem::create_directory("edits");
  put_bytes("edits/wall_lines.geojson", "x");
  put_bytes("outside.ply", "scan");
  Counted counted;
  EXPECT_EQ(counted.digests.of("edits/wall_lines.geojson"), sha256_hex("x"));
  EXPECT_EQ(counted.digests.of(kScanName), sha256_hex("scan"));
  EXPECT_EQ(counted.reads, 0);
  std::filesystem::remove("outside.ply");
  EXPECT_EQ(counted.digests.of(kScanName), kNoFile);
}

TEST(WorkDigests, small_files_go_by_their_bytes_whatever_they_state) {
  const WorkFolder folder;
  put_bytes("a.h5", "1");
  const auto payload_of = [](const std::filesystem::path&) { return std::string("payload"); };
  EXPECT_EQ(WorkDigests(payload_of).of("a.h5"), sha256_hex("1"));
  std::filesystem::resize_file("a.h5", kWholeUpTo + 1);
  EXPECT_EQ(WorkDigests(payload_of).of("a.h5"), "payload");
}

TEST(WorkDigests, a_file_that_cannot_be_read_has_a_digest_that_no_content_has) {
  const WorkFolder folder;
  put_bytes("a.h5", "1");
  WorkDigests digests(
      [](const std::filesystem::path&) -> std::string { throw std::runtime_error("damaged"); }, {}, 0);
  EXPECT_NE(digests.of("a.h5"), kNoFile);
  EXPECT_LT(digests.of("a.h5").size(), 64U);
}

TEST(WorkDigests, a_damaged_list_of_digests_costs_time_only) {
  const WorkFolder folder;
  put_bytes("a.h5", "1");
  for (const char* damaged : {"", "\n\n", "a b c", "1 2 3 4 5", "payload-9 0 0 0.0 0.0 a.h5\n"}) {
    put_bytes(kDigestFile, damaged);
    EXPECT_EQ(read_and_save(), "payload-1") << damaged;
  }
}

TEST(AppendDigest, spares_the_reading_and_never_for_a_file_of_this_very_moment) {
  const WorkFolder folder;
  put_bytes("a.h5", "1");
  wait_a_tick();
  append_digest("a.h5", *file_state("a.h5"), *file_system_now("stamps"), "known");
  EXPECT_EQ(Counted().digests.of("a.h5"), "known");
  FileSystemNow then;
  then.time = file_state("a.h5")->changed;
  then.device = file_state("a.h5")->device;
  std::filesystem::remove(kDigestFile);
  append_digest("a.h5", *file_state("a.h5"), then, "racy");
  EXPECT_EQ(Counted().digests.of("a.h5"), "payload-1");
}

TEST(WorkDigests, what_is_known_of_a_file_of_this_very_moment_is_not_kept) {
  const WorkFolder folder;
  put_bytes("a.h5", "1");
  const FileState state = *file_state("a.h5");
  Counted counted;
  counted.digests.note("a.h5", state, {state.changed, state.device}, "racy");
  EXPECT_EQ(counted.digests.of("a.h5"), "payload-1");
  wait_a_tick();
  counted.digests.note("a.h5", state, *file_system_now("stamps"), "known");
  EXPECT_EQ(counted.digests.of("a.h5"), "known");
}

TEST(IsSettled, asks_for_two_seconds_on_another_file_system) {
  FileState state;
  state.device = 1;
  state.changed = {100, 5};
  EXPECT_TRUE(is_settled(state, {{100, 6}, 1}));
  EXPECT_FALSE(is_settled(state, {{100, 5}, 1}));
  EXPECT_FALSE(is_settled(state, {{102, 5}, 2}));
  EXPECT_TRUE(is_settled(state, {{102, 6}, 2}));
}

TEST(FileSystemNow, follows_no_link_out_of_the_folder) {
  const WorkFolder folder;
  put_bytes("precious", "1");
  make_old("precious");
  std::filesystem::create_symlink(std::filesystem::current_path() / "precious", "stamps/.clock");
  EXPECT_FALSE(file_system_now("stamps"));
  EXPECT_TRUE(is_old("precious"));
}

}  // namespace
}  // namespace roomcut::test
