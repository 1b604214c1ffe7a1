// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <thread>

#include "common/artefact/h5.h"
#include "tests/unit/artefact/temporary_folder.h"

namespace roomcut::test {

namespace {

constexpr ArtefactType kType{"cells", 1, 2};

void write_sample(const std::filesystem::path& path, ArtefactType type = kType) {
  H5Writer writer(path, type, {}, {});
  writer.write<double>("v", std::vector<double>(1000, 1.5), "m", "values");
  writer.commit();
}

std::string open_code(const std::filesystem::path& path, std::string* text = nullptr) {
  return code_of([&] { const H5Reader reader(path, kType); }, text);
}

}  // namespace

TEST(H5Refusals, names_another_type_and_both_types) {
  const TemporaryFolder folder;
  std::string text;
  write_sample(folder / "a.h5", {"slices", 1, 0});
  EXPECT_EQ(open_code(folder / "a.h5", &text), "A03");
  EXPECT_NE(text.find("slices"), std::string::npos);
  EXPECT_NE(text.find("cells"), std::string::npos);
}

TEST(H5Refusals, takes_older_minor_versions_and_no_others) {
  const TemporaryFolder folder;
  const auto code = [&](int major, int minor, std::string* text = nullptr) {
    write_sample(folder / "a.h5", {"cells", major, minor});
    return open_code(folder / "a.h5", text);
  };
  std::string text;
  EXPECT_EQ(code(1, 2), "");
  EXPECT_EQ(code(1, 0), "");
  EXPECT_EQ(code(1, 3, &text), "A04");
  EXPECT_NE(text.find("1.3"), std::string::npos);
  EXPECT_NE(text.find("1.2"), std::string::npos);
  EXPECT_EQ(code(2, 0), "A04");
  EXPECT_EQ(code(0, 9), "A04");
}

TEST(H5Refusals, tells_a_missing_file_from_a_damaged_one) {
  const TemporaryFolder folder;
  EXPECT_EQ(open_code(folder / "none.h5"), "A01");
  EXPECT_EQ(open_code(folder.path()), "A01");
  put_bytes(folder / "a.h5", "");
  EXPECT_EQ(open_code(folder / "a.h5"), "A02");
  put_bytes(folder / "a.h5", "ply\nformat ascii 1.0\n");
  EXPECT_EQ(open_code(folder / "a.h5"), "A02");
}

TEST(H5Refusals, notices_a_file_cut_at_any_length) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const std::string bytes = bytes_of(folder / "a.h5");
  for (std::size_t size = 0; size < bytes.size(); size += 501) {
    put_bytes(folder / "b.h5", bytes.substr(0, size));
    const std::string code = code_of([&] { H5Reader(folder / "b.h5", kType).read<double>("v"); });
    EXPECT_EQ(code, "A02") << "cut at " << size;
  }
}

TEST(H5Refusals, survives_any_damaged_byte) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const std::string bytes = bytes_of(folder / "a.h5");
  for (std::size_t at = 0; at < bytes.size(); at += 13) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    put_bytes(folder / "b.h5", damaged);
    std::vector<double> values(1000, 1.5);
    const std::string code = code_of([&] { values = H5Reader(folder / "b.h5", kType).read<double>("v"); });
    EXPECT_TRUE(code != "" || values == std::vector<double>(1000, 1.5)) << "believed at byte " << at;
  }
}

TEST(H5Refusals, names_file_and_dataset) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const H5Reader reader(folder / "a.h5", kType);
  std::string text;
  EXPECT_EQ(code_of([&] { reader.read<double>("levels/none"); }, &text), "A02");
  EXPECT_NE(text.find("a.h5: /levels/none"), std::string::npos) << text;
  EXPECT_EQ(code_of([&] { reader.read<double>("v", {0, 3}); }), "A02");
  EXPECT_EQ(code_of([&] { reader.read<double>("v", {999}); }), "A02");
  EXPECT_EQ(code_of([&] { reader.read<double>("v", {1000}); }), "");
  EXPECT_EQ(code_of([&] { reader.read<std::int32_t>("v"); }), "A02") << "no silent rounding";
  double one = 0;
  EXPECT_EQ(code_of([&] { reader.read_rows("v", 999, 1, &one); }), "");
  EXPECT_EQ(code_of([&] { reader.read_rows("v", 1000, 1, &one); }), "A02");
  EXPECT_EQ(code_of([&] { reader.attribute_double("v", "none"); }), "A02");
  EXPECT_EQ(code_of([&] { reader.attribute_double("v", "unit"); }), "A02");
}

TEST(H5Refusals, a_dataset_that_is_not_filled_cannot_be_published) {
  const TemporaryFolder folder;
  H5Writer writer(folder / "a.h5", kType, {}, {});
  writer.begin<double>("v", {3}, "m", "values");
  writer.append<double>("v", std::vector<double>{1, 2});
  EXPECT_THROW(writer.append<double>("v", std::vector<double>{3, 4}), std::logic_error);
  EXPECT_THROW(writer.append<float>("v", std::vector<float>{3}), std::logic_error);
  EXPECT_THROW(writer.commit(), std::logic_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
}

TEST(H5Refusals, a_killed_writer_leaves_the_old_file) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const std::string before = bytes_of(folder / "a.h5");
  const pid_t pid = ::fork();
  if (pid == 0) {
    H5Writer writer(folder / "a.h5", kType, {}, {});
    writer.begin<double>("v", {1000000}, "m", "values");
    writer.append<double>("v", std::vector<double>(500000, 1.0));
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(bytes_of(folder / "a.h5"), before);
}

TEST(H5Refusals, a_full_disk_is_an_error_and_leaves_no_file) {
  const TemporaryFolder folder;
  // Different limits let the disk fill up at the data, at the metadata and at the last flush.
  for (const rlim_t limit_bytes : {100U, 1000U, 4000U, 7000U, 9000U, 11000U}) {
    const pid_t pid = ::fork();
    if (pid == 0) {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{limit_bytes, limit_bytes};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      std::string text;
      const std::string code = code_of([&] { write_sample(folder / "a.h5"); }, &text);
      ::_exit(code == "O01" ? 7 : code.empty() ? 8 : 9);
    }
    int status = 0;
    ::waitpid(pid, &status, 0);
    ASSERT_TRUE(WIFEXITED(status)) << limit_bytes;
    EXPECT_EQ(WEXITSTATUS(status), 7) << limit_bytes;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << limit_bytes;
  }
}

// A stage may write from a thread that did not open the file; the library's own words on the error would bury
// ours.
TEST(H5Refusals, a_full_disk_met_by_another_thread_prints_nothing) {
  const TemporaryFolder folder;
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    testing::internal::CaptureStderr();
    H5Writer writer(folder / "a.h5", kType, {}, {});
    writer.begin<double>("v", {100000}, "m", "values");
    const rlimit limit{4000, 4000};
    std::string code;
    std::thread([&] {
      ::setrlimit(RLIMIT_FSIZE, &limit);
      code = code_of([&] { writer.append<double>("v", std::vector<double>(100000, 1.0)); });
    }).join();
    ::_exit(code == "O01" && testing::internal::GetCapturedStderr().empty() ? 7 : 8);
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST(InspectArtefact, reads_what_an_artefact_states_and_hashes_any_other_file) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const InputRecord record = inspect_artefact(folder / "a.h5");
  EXPECT_EQ(record.artefact, "cells");
  EXPECT_EQ(record.schema_version, "1.2");
  EXPECT_EQ(record.payload_sha256, H5Reader(folder / "a.h5", kType).payload_sha256());
  put_bytes(folder / "scan.ply", "ply");
  EXPECT_EQ(inspect_artefact(folder / "scan.ply").artefact, "");
  EXPECT_EQ(inspect_artefact(folder / "scan.ply").payload_sha256, sha256_hex("ply"));
  EXPECT_EQ(code_of([&] { inspect_artefact(folder / "none"); }), "A01");
}

}  // namespace roomcut::test
