// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "scan_files.h"
#include "stages/ingest/number_text.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

using ScanText = ScanFiles;

void expect_one_to_six(const ScanBlock& block, const std::string& what) {
  EXPECT_EQ(block.x, (std::vector<double>{1, 4})) << what;
  EXPECT_EQ(block.y, (std::vector<double>{2.5, -5})) << what;
  EXPECT_EQ(block.z, (std::vector<double>{3e-1, 6})) << what;
}

TEST_F(ScanText, reads_every_separator_with_and_without_a_last_line_break) {
  for (const std::string text :
       {"1 2.5 3e-1\n4 -5 6\n", "1\t2.5\t0.3\n4\t-5\t6", "1,2.5,.3\n4,-5,6.\n", "1;2.5;0.3\r\n4;-5;+6\r\n",
        " 1 ,  2.5 , 0.3\n 4 , -5 , 6\n", "  1   2.5  0.3  \n\n\t4  -5  6\n",
        "1,2.5,0.3,255,,7\n4,-5,6,1,2,3\n", "1 2.5 0.3 255 0 0\n4 -5 6\n",
        "\xef\xbb\xbf"
        "1 2.5 0.3\n4 -5 6\n"}) {
    expect_one_to_six(read_all(*open_scan(file("scan.xyz", text))), text);
  }
}

TEST_F(ScanText, reads_utf16_of_either_byte_order_with_any_line_ends) {
  for (const std::string text :
       {"x,y,z\n1,2.5,.3\n4,-5,6\n", "# a\r\n1 2.5 .3\r\n4 -5 6", "1;2.5;.3\r4;-5;6\r"}) {
    for (const bool big : {false, true}) {
      const std::string wide = utf16(text, big);
      expect_one_to_six(read_all(*open_scan(file("w.txt", wide))), text);
      expect_one_to_six(read_all(*open_scan(file("bare.txt", wide.substr(2)))), "no mark: " + text);
    }
  }
  std::string names = utf16("x y z h\n1 2.5 .3 0\n4 -5 6 0\n", false);
  names[7 * 2] = '\xf6';  // an umlaut instead of the h
  names[7 * 2 + 1] = '\x01';
  expect_one_to_six(read_all(*open_scan(file("u.txt", names))), "not ASCII");
}

TEST_F(ScanText, reads_lines_that_end_with_carriage_returns) {
  expect_one_to_six(read_all(*open_scan(file("cr.xyz", "1 2.5 0.3\r4 -5 6\r"))), "CR");
  expect_one_to_six(read_all(*open_scan(file("crh.csv", "x,y,z\r1,2.5,.3\r4,-5,6"))), "CR with names");
  expect_one_to_six(read_all(*open_scan(file("mixed.xyz", "# one\n1 2.5 0.3\r4 -5 6\r"))), "mixed");
  expect_one_to_six(read_all(*open_scan(file("crcrlf.xyz", "1 2.5 0.3\r\r\n4 -5 6\r\r\n"))), "CR CR LF");
  std::string text;
  EXPECT_EQ(code_of_scan(file("bad.xyz", "1 2 3\r4 5 6\r7 x 9\r"), &text), "C08");
  EXPECT_NE(text.find("line 3"), std::string::npos) << text;
}

TEST_F(ScanText, reads_utf16_and_carriage_returns_over_many_blocks) {
  std::string text;
  constexpr int kLines = 200'000;
  for (int i = 0; i < kLines; ++i) {
    text += std::to_string(i) + " 1.25 -" + std::to_string(i % 11) + "\r";
  }
  const auto reader = open_scan(file("many.xyz", utf16(text, true)));
  EXPECT_GT(reader->blocks(), 1U);
  const ScanBlock block = read_all(*reader);
  ASSERT_EQ(block.size(), static_cast<std::size_t>(kLines));
  EXPECT_EQ(block.x.back(), kLines - 1);
}

TEST_F(ScanText, says_when_all_points_stand_on_one_line) {
  std::string numbers;
  for (int i = 0; i < 100; ++i) {
    numbers += std::to_string(i) + ".5 ";
  }
  for (const std::string& text : {numbers, numbers + "\n", "x y z " + numbers}) {
    std::string message;
    EXPECT_EQ(code_of_scan(file("line.xyz", text), &message), "C04");
    EXPECT_NE(message.find("one line"), std::string::npos) << message;
  }
}

TEST_F(ScanText, follows_a_line_of_names) {
  for (const std::string text :
       {"x,y,z\n1,2.5,.3\n4,-5,6\n", "\"Z\";\"Y\";\"X\"\n.3;2.5;1\n6;-5;4\n",
        "//X Y Z R G B\n1 2.5 .3 0 0 0\n4 -5 6 1 1 1\n", "# intensity x y z\n9 1 2.5 .3\n9 4 -5 6\n",
        "Intensity\tEasting [m]\tNorthing [m]\tHeight [m]\n9\t1\t2.5\t.3\n9\t4\t-5\t6\n",
        "% made by hand\nSurvey of the office\n1 2.5 .3\n4 -5 6\n"}) {
    expect_one_to_six(read_all(*open_scan(file("scan.csv", text))), text);
  }
}

TEST_F(ScanText, reads_named_normals) {
  const auto reader = open_scan(file("n.txt", "x y z nx ny nz\n1 2.5 .3 0 0.6 0.8\n4 -5 6 1 0 0\n"));
  ASSERT_TRUE(reader->has_normals());
  const ScanBlock block = read_all(*reader);
  expect_one_to_six(block, "normals");
  EXPECT_EQ(block.nz, (std::vector<float>{0.8F, 0}));
  EXPECT_FALSE(open_scan(file("m.txt", "1 2 3 0 0 1\n"))->has_normals()) << "unnamed columns may be colours";
}

TEST_F(ScanText, accepts_the_counts_of_pts_files) {
  expect_one_to_six(read_all(*open_scan(file("a.pts", "2\n1 2.5 .3 100 9 9 9\n4 -5 6 100 9 9 9\n"))),
                    "one count");
  expect_one_to_six(read_all(*open_scan(file("b.pts", "1\r\n1 2.5 .3\r\n1\r\n4 -5 6\r\n"))), "two counts");
  EXPECT_EQ(code_of_scan(file("c.pts", "3\n1 2.5 .3\n4 -5 6\n")), "C05");
  EXPECT_EQ(code_of_scan(file("d.pts", "4000000000\n1 2.5 .3\n4 -5 6\n")), "C05");
  EXPECT_EQ(code_of_scan(file("e.pts", "1\n1 2.5 .3\n4 -5 6\n")), "C05") << "more than promised";
}

TEST_F(ScanText, skips_comments_and_blank_lines_anywhere) {
  expect_one_to_six(read_all(*open_scan(file("c.asc", "# a\n\n1 2.5 .3\n  # b\n// c\n   \n4 -5 6\n# d"))),
                    "comments");
}

TEST_F(ScanText, keeps_nan_and_infinity_for_the_count_of_dropped_points) {
  const ScanBlock block = read_all(*open_scan(file("n.xyz", "1 2 3\nnan 2 3\n1 -inf 3\n1 2 1e999\n")));
  ASSERT_EQ(block.size(), 4U);
  EXPECT_TRUE(std::isnan(block.x[1]));
  EXPECT_TRUE(std::isinf(block.y[2]));
  EXPECT_FALSE(std::isfinite(block.z[3]));
}

TEST_F(ScanText, gives_every_line_once_over_many_blocks) {
  std::string text;
  constexpr int kLines = 300'000;
  for (int i = 0; i < kLines; ++i) {
    text += std::to_string(i) + " " + std::to_string(i % 97) + ".5 -" + std::to_string(i % 11) + "\n";
  }
  const auto reader = open_scan(file("many.xyz", text));
  EXPECT_GT(reader->blocks(), 1U);
  const ScanBlock block = read_all(*reader);
  ASSERT_EQ(block.size(), static_cast<std::size_t>(kLines));
  for (int i = 0; i < kLines; ++i) {
    ASSERT_EQ(block.x[static_cast<std::size_t>(i)], i);
    ASSERT_EQ(block.y[static_cast<std::size_t>(i)], i % 97 + 0.5);
  }
}

TEST_F(ScanText, names_the_line_that_is_no_point_in_any_block) {
  std::string text;
  for (int i = 0; i < 250'000; ++i) {
    text += "1.25 2.25 3.25\n";
  }
  std::string message;
  EXPECT_EQ(code_of_scan(file("bad.xyz", text + "1.25 oops 3\n" + text), &message), "C08");
  EXPECT_NE(message.find("line 250001"), std::string::npos) << message;
  EXPECT_NE(message.find("1.25 oops 3"), std::string::npos) << message;
  EXPECT_EQ(code_of_scan(file("short.xyz", "1 2 3\n1 2\n")), "C08");
  EXPECT_EQ(code_of_scan(file("glued.xyz", "1 2 3\n1 2 3x\n")), "C08");
  EXPECT_EQ(code_of_scan(file("cut.csv", "1,2,3\n4,5")), "C08");
}

TEST_F(ScanText, refuses_what_is_no_point_cloud) {
  EXPECT_EQ(code_of_scan(file("letter.txt", "Dear Sir or Madam,\nplease find enclosed\nnothing.\n")), "C04");
  EXPECT_EQ(code_of_scan(file("two.txt", "1 2\n3 4\n")), "C04");
  EXPECT_EQ(code_of_scan(file("grid.asc", "ncols 4\nnrows 4\nxllcorner 0\n1 2 3 4\n")), "C04");
  EXPECT_EQ(code_of_scan(file("scan.ptx", "2\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n")), "C04");
  EXPECT_EQ(code_of_scan(file("binary.dat", std::string("ab\0cd", 5))), "C04");
}

TEST_F(ScanText, says_what_to_run_when_there_is_no_environment_to_decode_a_format) {
  for (const std::string bytes : {"LASF and more", "ASTM-E57 and more"}) {
    std::string text;
    EXPECT_EQ(code_of_scan(file("scan.bin", bytes), &text), "C12");
    EXPECT_NE(text.find("make deps"), std::string::npos) << text;
  }
}

TEST_F(ScanText, refuses_a_header_without_points) {
  EXPECT_EQ(code_of_scan(file("h.csv", "x,y,z\n")), "C06");
  EXPECT_EQ(code_of_scan(file("c.txt", "# nothing\n")), "C06");
  EXPECT_EQ(code_of_scan(file("p.pts", "0\n")), "C06");
}

TEST(NumberText, agrees_with_the_library_on_every_form) {
  for (const std::string text :
       {"0", "-0.0", "1", "+1.5", "-12.375", ".5", "5.", "123456789012345", "0.1", "3.14159265358979", "1e5",
        "-2.5E-3", "12345678901234567890.5", "0.000000000000000000000123", "9007199254740993", "4.35", "0.3",
        "2.2250738585072014e-308", "179769313486231570000000000000000000000"}) {
    double value = 0;
    const char* end = text.data() + text.size();
    ASSERT_EQ(parse_number(text.data(), end, value), end) << text;
    EXPECT_EQ(value, std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(NumberText, refuses_what_is_no_number) {
  for (const std::string text : {"", "-", "+", ".", "-.", "e5", "x", ",", "--1"}) {
    double value = 0;
    EXPECT_EQ(parse_number(text.data(), text.data() + text.size(), value), nullptr) << text;
  }
}

}  // namespace
}  // namespace roomcut::testing
