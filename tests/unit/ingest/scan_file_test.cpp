// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/stat.h>

#include "scan_files.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

using ScanFileTest = ScanFiles;

TEST_F(ScanFileTest, gives_missing_files_and_folders_their_code) {
  EXPECT_EQ(code_of_scan(folder() / "absent.ply"), "C01");
  EXPECT_EQ(code_of_scan(file("x", "1 2 3\n") / "below.ply"), "C01");
  EXPECT_EQ(code_of_scan(folder()), "C01");
}

TEST_F(ScanFileTest, gives_unreadable_files_their_code) {
  EXPECT_EQ(code_of_scan("/dev/null"), "C02");
  const auto pipe = folder() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(code_of_scan(pipe), "C02") << "and does not wait for a writer";
  if (::geteuid() == 0) {
    GTEST_SKIP() << "skipped the file without permission: root may read everything";
  }
  const auto locked = file("locked.xyz", "1 2 3\n");
  ASSERT_EQ(::chmod(locked.c_str(), 0), 0);
  EXPECT_EQ(code_of_scan(locked), "C02");
}

TEST_F(ScanFileTest, gives_empty_files_their_code) {
  EXPECT_EQ(code_of_scan(file("empty.ply", "")), "C03");
}

TEST_F(ScanFileTest, says_when_a_file_shrinks_while_it_is_read) {
  const auto path = file("a.xyz", std::string(100, 'a'));
  const ScanFile scan(path);
  std::filesystem::resize_file(path, 10);
  std::string bytes(100, '\0');
  EXPECT_EQ(code_of([&] { scan.read(0, bytes.data(), bytes.size()); }), "C05");
}

TEST_F(ScanFileTest, reads_only_what_is_there) {
  const ScanFile scan(file("a.xyz", "0123456789"));
  std::string bytes(20, '\0');
  EXPECT_EQ(scan.read(4, bytes.data(), 20), 6U);
  EXPECT_EQ(bytes.substr(0, 6), "456789");
  EXPECT_EQ(scan.read(10, bytes.data(), 20), 0U);
}

}  // namespace
}  // namespace roomcut::testing
