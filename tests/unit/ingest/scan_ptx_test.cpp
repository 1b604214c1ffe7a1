// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan_files.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

using ScanPtx = ScanFiles;

const std::string kAxes = "1 0 0\n0 1 0\n0 0 1\n";
const std::string kUnmoved = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

std::string scan(int columns, int rows, const std::string& matrix, const std::string& points,
                 const std::string& position = "0 0 0") {
  return std::to_string(columns) + "\n" + std::to_string(rows) + "\n" + position + "\n" + kAxes + matrix +
         points;
}

TEST_F(ScanPtx, brings_all_scans_into_common_coordinates_and_finds_their_positions) {
  // The second is turned by 90° about z (row vectors) and moved.
  const std::string turned = "0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n";
  const std::string text = scan(2, 1, kUnmoved, "1 2 3 .5\n4 5 6 .5\n", "7 8 9") + "\n" +
                           scan(1, 2, turned, "1 2 3 .5 9 9 9\n4 5 6 .5 9 9 9\n", "10 20 30");
  for (const std::string& bytes : {text, utf16(text, true)}) {
    const auto reader = open_scan(file("s.ptx", bytes));
    const ScanBlock block = read_all(*reader);
    EXPECT_EQ(block.x, (std::vector<double>{1, 4, 8, 5}));
    EXPECT_EQ(block.y, (std::vector<double>{2, 5, 21, 24}));
    EXPECT_EQ(block.z, (std::vector<double>{3, 6, 33, 36}));
    EXPECT_EQ(reader->stations(), (std::vector<Vec3>{Vec3(7, 8, 9), Vec3(10, 20, 30)}));
  }
}

TEST_F(ScanPtx, drops_and_counts_beams_without_return_before_they_are_moved) {
  const auto reader = open_scan(file(
      "z.ptx", scan(3, 1, "1 0 0 0\n0 1 0 0\n0 0 1 0\n10 20 30 1\n", "0 0 0 0\n1 2 3 .5\n0.000 0 -0 .5\n")));
  ScanBlock block;
  reader->read(0, block);
  EXPECT_EQ(block.x, std::vector<double>{11});
  EXPECT_EQ(block.no_returns, 2U);
}

TEST_F(ScanPtx, takes_no_wrong_matrix_for_the_identity) {
  const std::string points = "1 2 3 .5\n";
  for (const std::string matrix :
       {"1 0 0 0\n0 1 0 0\n0 0 1 0\n1 2 nan 1\n", "0 0 0 0\n0 0 0 0\n0 0 0 0\n0 0 0 1\n",
        "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "1 0 0 5\n0 1 0 0\n0 0 1 0\n0 0 0 1\n",
        "1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 0\n",
        "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 zero 1\n", "1 0 0 0\n0 1 0 0\n0 0 1\n0 0 0 1\n"}) {
    std::string text;
    EXPECT_EQ(code_of_scan(file("m.ptx", scan(1, 1, matrix, points)), &text), "C04") << matrix;
    EXPECT_EQ(code_of_scan(file("n.ptx", scan(1, 1, kUnmoved, points) + scan(1, 1, matrix, points)), &text),
              "C04")
        << matrix;
    EXPECT_NE(text.find("scan 2"), std::string::npos) << text;
  }
}

TEST_F(ScanPtx, refuses_other_numbers_of_points_than_promised) {
  EXPECT_EQ(code_of_scan(file("a.ptx", scan(3, 1, kUnmoved, "1 2 3 .5\n4 5 6 .5\n"))), "C05");
  EXPECT_EQ(code_of_scan(file("b.ptx", scan(1, 1, kUnmoved, "1 2 3 .5\n4 5 6 .5\n"))), "C05");
  EXPECT_EQ(code_of_scan(file("c.ptx", scan(60000, 60000, kUnmoved, "1 2 3 .5\n"))), "C05");
  EXPECT_EQ(code_of_scan(file("d.ptx", scan(1, 1, kUnmoved, "1 2 3 .5\n") + "5\n5\n")), "C04")
      << "a second header";
  std::string text;
  EXPECT_EQ(code_of_scan(file("e.ptx", scan(2, 1, kUnmoved, "1 2 3 .5\n4 x 6 .5\n")), &text), "C08");
  EXPECT_NE(text.find("line 12"), std::string::npos) << text;
}

TEST_F(ScanPtx, reads_a_scan_over_many_blocks) {
  std::string points;
  constexpr int kPoints = 200'000;
  for (int i = 0; i < kPoints; ++i) points += std::to_string(i) + ".25 1 2 0.125\n";
  const std::string moved = "1 0 0 0\n0 1 0 0\n0 0 1 0\n1 0 0 1\n";
  const auto reader =
      open_scan(file("l.ptx", scan(kPoints, 1, moved, points) + scan(kPoints, 1, kUnmoved, points)));
  EXPECT_GT(reader->blocks(), 3U);
  const ScanBlock block = read_all(*reader);
  ASSERT_EQ(block.size(), 2U * kPoints);
  for (int i = 0; i < kPoints; ++i) {
    ASSERT_EQ(block.x[static_cast<std::size_t>(i)], i + 1.25);
    ASSERT_EQ(block.x[static_cast<std::size_t>(kPoints + i)], i + 0.25);
  }
}

}  // namespace
}  // namespace roomcut::testing
