// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_stations.h"
#include "scan_files.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

using ScanStations = ScanFiles;

TEST_F(ScanStations, come_from_one_comment_each) {
  const std::vector<Vec3> stations =
      stations_of_comments({"station 1 2 3", "a remark", "Station -1.5, 0.25, 1e1"});
  ASSERT_EQ(stations.size(), 2U);
  EXPECT_EQ(stations[0], Vec3(1, 2, 3));
  EXPECT_EQ(stations[1], Vec3(-1.5, 0.25, 10));
}

TEST_F(ScanStations, come_from_a_list_and_follow_the_offset_it_names) {
  const std::vector<Vec3> stations = stations_of_comments(
      {"scanner positions (before offset): 0 0 0 and 1.5 0.5 0.25", "offset_subtracted 1 2 0"});
  ASSERT_EQ(stations.size(), 2U);
  EXPECT_EQ(stations[0], Vec3(-1, -2, 0));
  EXPECT_EQ(stations[1], Vec3(0.5, -1.5, 0.25));
  EXPECT_EQ(stations_of_comments({"scanner positions: 1 2 3", "offset_subtracted 1 2 0"}).at(0),
            Vec3(1, 2, 3));
}

TEST_F(ScanStations, are_not_read_into_other_comments) {
  EXPECT_TRUE(stations_of_comments({"station", "station 1 2", "station 1 2 x", "station 1 2 3 4",
                                    "power station 1 2 3", "scanner positions 1 2 3",
                                    "scanner positions: 1 2 3 4", "offset_subtracted 1 2 3"})
                  .empty());
}

TEST_F(ScanStations, come_from_a_text_file) {
  const std::vector<Vec3> stations = read_stations(file("s.txt", "# x y z\n1 2 3\n\n4,5,6 first floor\r\n"));
  ASSERT_EQ(stations.size(), 2U);
  EXPECT_EQ(stations[1], Vec3(4, 5, 6));
  for (const std::string& bytes : {utf16("1 2 3\r\n4 5 6\r\n", false), std::string("1 2 3\r4 5 6\r")}) {
    EXPECT_EQ(read_stations(file("w.txt", bytes)), (std::vector<Vec3>{Vec3(1, 2, 3), Vec3(4, 5, 6)}));
  }
  std::string text;
  EXPECT_EQ(code_of([&] { read_stations(file("b.txt", "1 2 3\n1 2\n")); }, &text), "C08");
  EXPECT_NE(text.find("line 2"), std::string::npos) << text;
  EXPECT_EQ(code_of([&] { read_stations(folder() / "absent.txt"); }), "C01");
}

}  // namespace
}  // namespace roomcut::testing
