// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/text_columns.h"

#include <cmath>

#include "scan_files.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

using TextColumns = ScanFiles;

void expect_one_to_six(const ScanReader& reader, const std::string& what) {
  const ScanBlock block = read_all(reader);
  EXPECT_EQ(block.x, (std::vector<double>{1.5, 4})) << what;
  EXPECT_EQ(block.y, (std::vector<double>{2.5, -5})) << what;
  EXPECT_EQ(block.z, (std::vector<double>{0.25, 6})) << what;
}

TEST_F(TextColumns, follow_names_split_as_the_lines_are) {
  for (const std::string text :
       {"Scan ID,X,Y,Z,Intensity\n7,1.5,2.5,.25,9\n7,4,-5,6,9\n",
        "GPS Time [s],X [m],Y [m],Z [m]\n12.5,1.5,2.5,.25\n12.75,4,-5,6\n",
        "GPS Time\tX\tY\tZ\n12.5\t1.5\t2.5\t.25\n12.75\t4\t-5\t6\n",
        "\"Point name\" \"y\" \"x\" \"z\"\n\"a b\" 2.5 1.5 .25\n\"c\" -5 4 6\n",
        "\"name, or id\",\"x\",\"y\",\"z\"\n\"a, b\",\"1.5\",\"2.5\",\"0.25\"\n\"c\",4,-5,6\n",
        "X [m] Y [m] Z [m] R\n1.5 2.5 .25 0\n4 -5 6 0\n", "x,y,z\n1.5 2.5 .25\n4 -5 6\n",
        "X,Y,Z\n[m],[m],[m]\n1.5,2.5,.25\n4,-5,6\n", "X,Y,Z,\n1.5,2.5,.25,\n4,-5,6,\n"}) {
    expect_one_to_six(*open_scan(file("scan.csv", text)), text);
  }
}

TEST_F(TextColumns, know_the_usual_names_of_coordinates) {
  for (const std::string names :
       {"x;y;z", "X_m;Y_m;Z_m", "pos_x;pos_y;pos_z", "Point X;Point Y;Point Z", "coordX;coordY;coordZ",
        "Easting;Northing;Elevation", "E;N;H", "Rechtswert;Hochwert;H\xc3\xb6he",
        "Rechtswert [m];Hochwert [m];H\xf6he", "x;y;height", "//X;Y;Z", "Cartesian X;Cartesian Y;Cartesian Z",
        "x (m);y (m);Altitude (m)"}) {
    const auto reader = open_scan(file("n.csv", "id;" + names + "\n9;1.5;2.5;.25\n3;4;-5;6\n"));
    expect_one_to_six(*reader, names);
    ASSERT_EQ(reader->notes().size(), 1U);
    EXPECT_NE(reader->notes()[0].find("x is column 2"), std::string::npos) << reader->notes()[0];
  }
}

TEST_F(TextColumns, step_over_an_index_or_row_name_that_has_no_name) {
  for (const std::string text : {"\"x\" \"y\" \"z\"\n\"1\" 1.5 2.5 .25\n\"2\" 4 -5 6\n",
                                 "x y z\n1 1.5 2.5 .25\n2 4 -5 6\n", "x,y,z\n0,1.5,2.5,.25\n1,4,-5,6\n",
                                 "x y z\nP1 1.5 2.5 .25\nP2 4 -5 6\n", "P1 1.5 2.5 .25\nP2 4 -5 6\n"}) {
    expect_one_to_six(*open_scan(file("r.txt", text)), text);
  }
  const ScanBlock block = read_all(*open_scan(file("i.txt", "5 1.5 2 3\n6 2.5 2 3\n7 3.5 2 3\n8 4.5 2 3\n")));
  EXPECT_EQ(block.x, (std::vector<double>{1.5, 2.5, 3.5, 4.5})) << "the first column counts the lines";
}

TEST_F(TextColumns, read_decimal_commas_also_beside_whole_numbers) {
  for (const std::string text :
       {"1,5;2,5;0,25\n4;-5;6\n", "1,5 2,5 0,25\n4 -5 6\n", "x\ty\tz\n1,5\t2,5\t0,25\n4\t-5\t6\n",
        "X;Y;Z;I\n1,5;2,5;0,25;100\n4;-5;6;1\n", "100 1,5 2,5 0,25\n101 4 -5 6\n102 4 -5 6\n"}) {
    const ScanBlock block = read_all(*open_scan(file("c.csv", text)));
    EXPECT_EQ(block.x[0], 1.5) << text;
    EXPECT_EQ(block.z[0], 0.25) << text;
    EXPECT_EQ(block.x[1], 4) << text;
  }
}

TEST_F(TextColumns, take_missing_coordinates_as_points_that_are_none) {
  for (const std::string text :
       {"x,y,z\n1.5,2.5,.25\nNA,2,3\n1,,3\n4,-5,6\n", "1.5 2.5 .25\n1 NA 3\n1 n/a 3\n4 -5 6\n",
        "x;y;z\n1.5;2.5;.25\n1;null;3\n1;2;\n4;-5;6\n"}) {
    const ScanBlock block = read_all(*open_scan(file("m.csv", text)));
    ASSERT_EQ(block.size(), 4U) << text;
    for (const std::size_t i : {1U, 2U}) {
      EXPECT_FALSE(std::isfinite(block.x[i] + block.y[i] + block.z[i])) << text;
    }
    EXPECT_EQ(block.x[3], 4) << text;
  }
}

TEST_F(TextColumns, are_refused_with_all_that_is_known_when_they_are_not_certain) {
  for (const std::string text :
       {"x y z\n7.5 1.5 2.5 .25\n7.25 4 -5 6\n",               // fewer names than fields, no index
        "a,b,c\n1.5,2.5,.25\n4,-5,6\n",                        // unknown names
        "id,x,y,level of water\n1,1.5,2.5,.25\n2,4,-5,6\n",    // no height
        "x,y,z,x,y,z\n1,2,3,4,5,6.5\n1,2,3,4,5,6.5\n",         // named twice
        "X,Y,Easting,Northing,H\n1,2,3,4,5.5\n1,2,3,4,5.5\n",  // two sets
        "lat,lon,alt\n48.1,11.5,500.2\n48.1,11.6,500.3\n",     // degrees
        "# time x y z\n1.5 2.5 .25\n4 -5 6\n",                 // a comment that does not fit
        "1,5,2,25,3,0\n1,5,2,25,3,5\n", "x,y,z\n1,5,2,25,3,0\n1,5,2,25,3,5\n",  // decimal commas
        "wall 1.5 2.5 .25\nthe floor 4 -5 6\n"}) {  // names with and without a blank
    std::string message;
    EXPECT_EQ(code_of_scan(file("u.csv", text), &message), "C11") << text;
    EXPECT_NE(message.find("first line '"), std::string::npos) << message;
    EXPECT_NE(message.find("--columns"), std::string::npos) << message;
  }
}

TEST_F(TextColumns, are_those_that_the_user_names) {
  const auto read = [this](const std::string& text, const std::string& columns) {
    return open_scan(file("g.csv", text), {parse_columns(columns), folder()});
  };
  expect_one_to_six(*read("a,b,c\n2.5,1.5,.25\n-5,4,6\n", "y,x,z"), "other names");
  expect_one_to_six(*read("7.5 1.5 2.5 .25 9\n7.25 4 -5 6 9\n", "time x y z"), "no names");
  expect_one_to_six(*read("x y z\n7.5 1.5 2.5 .25\n7.25 4 -5 6\n", "- x y z -"), "wrong names");
  EXPECT_EQ(code_of([&] { read("1 2 3\n4 5 6\n", "- - x y z"); }), "C11") << "more columns than there are";
  EXPECT_TRUE(parse_columns("").empty());
  for (const std::string wrong : {"x,y", "x,y,z,z", "a,b,c", "x,y,z,nx"}) {
    EXPECT_EQ(code_of([&] { parse_columns(wrong); }), "U01") << wrong;
  }
}

TEST_F(TextColumns, leave_prose_and_comments_alone) {
  for (const std::string text :
       {"# x y z in metres, made by hand\n1.5 2.5 .25\n4 -5 6\n",
        "Survey of the office\n1.5 2.5 .25\n4 -5 6\n", "Survey of 28 11 2026\n1.5 2.5 .25\n4 -5 6\n",
        "# columns: x y z i\n1.5 2.5 .25 1\n4 -5 6 1\n",
        "// 1 2 3 4\nid x y z\n9 1.5 2.5 .25\n# 1 2 3 4\n8 4 -5 6\n"}) {
    expect_one_to_six(*open_scan(file("p.txt", text)), text);
  }
}

TEST(BareName, has_no_case_punctuation_or_unit) {
  EXPECT_EQ(bare_name("Pos_X [m]"), "posx");
  EXPECT_EQ(bare_name("X_mm"), "x");
  EXPECT_EQ(bare_name("//X"), "x");
  EXPECT_EQ(bare_name("m"), "m");
  EXPECT_EQ(bare_name("[m]"), "");
}

}  // namespace
}  // namespace roomcut::testing
