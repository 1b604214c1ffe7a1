// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "scan_files.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

using ScanPly = ScanFiles;

std::string header(const std::string& format, const std::string& body) {
  return "ply\nformat " + format + " 1.0\ncomment made for a test\n" + body + "end_header\n";
}

const std::string kFloatVertex = "property float x\nproperty float y\nproperty float z\n";

std::string vertex(std::size_t count, const std::string& properties = kFloatVertex) {
  return "element vertex " + std::to_string(count) + "\n" + properties;
}

/// Three points with small whole coordinates, so that every scalar type can hold them.
template <class T>
std::string three_points(bool big_endian) {
  std::string bytes;
  for (int i = 0; i < 9; ++i) {
    bytes += bytes_of_value(static_cast<T>(i + 1), big_endian);
  }
  return bytes;
}

void expect_one_to_nine(const ScanBlock& block) {
  EXPECT_EQ(block.x, (std::vector<double>{1, 4, 7}));
  EXPECT_EQ(block.y, (std::vector<double>{2, 5, 8}));
  EXPECT_EQ(block.z, (std::vector<double>{3, 6, 9}));
}

template <class T>
void check_type(const std::string& type, const std::function<std::filesystem::path(std::string)>& make) {
  const std::string properties =
      "property " + type + " x\nproperty " + type + " y\nproperty " + type + " z\n";
  for (const bool big : {false, true}) {
    const std::string format = big ? "binary_big_endian" : "binary_little_endian";
    expect_one_to_nine(
        read_all(*open_scan(make(header(format, vertex(3, properties)) + three_points<T>(big)))));
  }
}

TEST_F(ScanPly, reads_every_scalar_type_in_both_byte_orders) {
  const auto make = [this](const std::string& bytes) { return file("scan.ply", bytes); };
  for (const char* name : {"char", "int8"}) check_type<std::int8_t>(name, make);
  for (const char* name : {"uchar", "uint8"}) check_type<std::uint8_t>(name, make);
  for (const char* name : {"short", "int16"}) check_type<std::int16_t>(name, make);
  for (const char* name : {"ushort", "uint16"}) check_type<std::uint16_t>(name, make);
  for (const char* name : {"int", "int32"}) check_type<std::int32_t>(name, make);
  for (const char* name : {"uint", "uint32"}) check_type<std::uint32_t>(name, make);
  for (const char* name : {"float", "float32"}) check_type<float>(name, make);
  for (const char* name : {"double", "float64"}) check_type<double>(name, make);
}

TEST_F(ScanPly, reads_ascii_with_any_order_of_properties) {
  const std::string properties =
      "property uchar red\nproperty double z\nproperty float y\nproperty float x\nproperty float intensity\n";
  const auto path =
      file("a.ply", header("ascii", vertex(3, properties)) + "9 3 2 1 .5\r\n9 6 5 4 .5\n\n9 9 8 7 .5");
  expect_one_to_nine(read_all(*open_scan(path)));
}

TEST_F(ScanPly, keeps_the_full_precision_of_doubles) {
  const std::string properties = "property double x\nproperty double y\nproperty double z\n";
  std::string bytes = header("binary_little_endian", vertex(1, properties));
  for (const double value : {3512345.6789, -0.1, 1e-7}) {
    bytes += bytes_of_value(value);
  }
  const ScanBlock block = read_all(*open_scan(file("d.ply", bytes)));
  EXPECT_EQ(block.x[0], 3512345.6789);
  EXPECT_EQ(block.y[0], -0.1);
  EXPECT_EQ(block.z[0], 1e-7);
}

TEST_F(ScanPly, reads_normals_between_other_properties) {
  const std::string properties =
      "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n" + kFloatVertex +
      "property double time\n";
  std::string bytes = header("binary_little_endian", vertex(2, properties));
  for (int i = 0; i < 2; ++i) {
    for (const float value : {0.6F, 0.8F, 0.0F}) bytes += bytes_of_value(value);
    bytes += bytes_of_value<std::uint8_t>(200);
    for (const float value : {1.5F, 2.5F, 3.5F}) bytes += bytes_of_value(value);
    bytes += bytes_of_value(1234.5);
  }
  const auto reader = open_scan(file("n.ply", bytes));
  ASSERT_TRUE(reader->has_normals());
  const ScanBlock block = read_all(*reader);
  EXPECT_EQ(block.x, (std::vector<double>{1.5, 1.5}));
  EXPECT_EQ(block.nx, (std::vector<float>{0.6F, 0.6F}));
  EXPECT_EQ(block.ny, (std::vector<float>{0.8F, 0.8F}));
}

TEST_F(ScanPly, skips_list_properties_of_the_vertices) {
  const std::string properties =
      "property list uchar int seen_by\n" + kFloatVertex + "property list ushort float w\n";
  for (const bool big : {false, true}) {
    std::string bytes = header(big ? "binary_big_endian" : "binary_little_endian", vertex(3, properties));
    for (int point = 0; point < 3; ++point) {
      bytes += bytes_of_value(static_cast<std::uint8_t>(point));
      for (int i = 0; i < point; ++i) bytes += bytes_of_value(std::int32_t{77}, big);
      for (int i = 1; i <= 3; ++i) bytes += bytes_of_value(static_cast<float>(3 * point + i), big);
      bytes += bytes_of_value(std::uint16_t{1}, big) + bytes_of_value(0.25F, big);
    }
    expect_one_to_nine(read_all(*open_scan(file("l.ply", bytes))));
  }
  const std::string text =
      header("ascii", vertex(3, properties)) + "0 1 2 3 0\n1 77 4 5 6 2 1 1\n2 7 7 7 8 9 0\n";
  expect_one_to_nine(read_all(*open_scan(file("la.ply", text))));
}

TEST_F(ScanPly, skips_elements_before_and_after_the_vertices) {
  const std::string camera = "element camera 2\nproperty double f\nproperty uchar k\n";
  const std::string strips = "element strip 2\nproperty list uchar int index\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  std::string before;
  for (int i = 0; i < 2; ++i) before += bytes_of_value(9.5) + bytes_of_value<std::uint8_t>(3);
  for (int i = 1; i <= 2; ++i) {
    before += bytes_of_value(static_cast<std::uint8_t>(i));
    for (int k = 0; k < i; ++k) before += bytes_of_value(std::int32_t{5});
  }
  const std::string after = bytes_of_value<std::uint8_t>(3) + three_points<std::int32_t>(false).substr(0, 12);
  const std::string head = header("binary_little_endian", camera + strips + vertex(3) + faces);
  expect_one_to_nine(read_all(*open_scan(file("e.ply", head + before + three_points<float>(false) + after))));
  const std::string text = header("ascii", camera + strips + vertex(3) + faces) +
                           "9.5 3\n9.5 3\n1 5\n2 5 5\n1 2 3\n4 5 6\n7 8 9\n3 0 1 2\n";
  expect_one_to_nine(read_all(*open_scan(file("ea.ply", text))));
}

TEST_F(ScanPly, accepts_carriage_returns_in_the_header) {
  std::string head = header("binary_little_endian", vertex(3));
  for (std::size_t at = 0; (at = head.find('\n', at)) != std::string::npos; at += 2) {
    head.replace(at, 1, "\r\n");
  }
  expect_one_to_nine(read_all(*open_scan(file("crlf.ply", head + three_points<float>(false)))));
}

TEST_F(ScanPly, gives_points_in_file_order_over_many_blocks) {
  constexpr std::size_t kPoints = 200'000;
  std::string bytes = header("binary_little_endian", vertex(kPoints));
  for (std::size_t i = 0; i < 3 * kPoints; ++i) bytes += bytes_of_value(static_cast<float>(i));
  const auto reader = open_scan(file("many.ply", bytes));
  EXPECT_GT(reader->blocks(), 1U);
  const ScanBlock block = read_all(*reader);
  ASSERT_EQ(block.size(), kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    ASSERT_EQ(block.y[i], static_cast<double>(static_cast<float>(3 * i + 1)));
  }
}

TEST_F(ScanPly, refuses_a_truncated_body) {
  const std::string whole = header("binary_little_endian", vertex(3)) + three_points<float>(false);
  std::string text;
  EXPECT_EQ(code_of_scan(file("t.ply", whole.substr(0, whole.size() - 1)), &text), "C05");
  EXPECT_NE(text.find("promises 3"), std::string::npos) << text;
  EXPECT_NE(text.find("holds 2"), std::string::npos) << text;
  EXPECT_EQ(code_of_scan(file("ta.ply", header("ascii", vertex(3)) + "1 2 3\n4 5 6\n")), "C05");
  const std::string lists = vertex(3, kFloatVertex + "property list uint float w\n");
  EXPECT_EQ(code_of_scan(file("tl.ply",
                              header("binary_little_endian", lists) + three_points<float>(false) + "xxxxxx")),
            "C05");
  EXPECT_EQ(code_of_scan(file("th.ply", "ply\nformat ascii 1.0\nelement ver")), "C05");
}

TEST_F(ScanPly, refuses_four_billion_promised_points_at_once) {
  for (const std::string count : {"4000000000", "18446744073709551615"}) {
    for (const std::string format : {"ascii", "binary_little_endian"}) {
      const std::string head = header(format, "element vertex " + count + "\n" + kFloatVertex);
      EXPECT_EQ(code_of_scan(file("lie.ply", head + "1 2 3\n4 5 6\n7 8 9\n")), "C05")
          << format << " " << count;
    }
    const std::string lists = "element a " + count + "\nproperty list uint double v\n" + vertex(3);
    EXPECT_EQ(
        code_of_scan(file("lie2.ply", header("binary_little_endian", lists) + three_points<float>(false))),
        "C05");
    const std::string empty = "element a " + count + "\nproperty uint v\n" + vertex(3);
    EXPECT_EQ(code_of_scan(file("lie3.ply", header("binary_big_endian", empty) + three_points<float>(true))),
              "C05");
  }
  const std::string huge = vertex(1, kFloatVertex + "property list uint double v\n");
  EXPECT_EQ(code_of_scan(file("lie4.ply", header("binary_little_endian", huge) +
                                              three_points<float>(false).substr(0, 12) + "\xff\xff\xff\xff")),
            "C05");
}

TEST_F(ScanPly, refuses_a_file_that_holds_more_points_than_promised_and_names_both_counts) {
  const std::string lists = vertex(1, kFloatVertex + "property list uchar int seen_by\n");
  std::string ragged = header("binary_little_endian", lists);
  for (int i = 0; i < 3; ++i) {
    ragged += bytes_of_value(1.0F) + bytes_of_value(2.0F) + bytes_of_value(3.0F) + '\0';
  }
  const std::string empty_faces = vertex(1) + "element face 0\nproperty list uchar int i\n";
  for (const std::string& bytes :
       {header("ascii", vertex(1)) + "1 2 3\n4 5 6\n7 8 9\n",
        header("ascii", vertex(1)) + "1 2 3\r4 5 6\r7 8 9",
        header("ascii", empty_faces) + "1 2 3\n\n4 5 6\n7 8 9",
        header("binary_little_endian", vertex(1)) + three_points<float>(false),
        header("binary_big_endian", empty_faces) + three_points<float>(true), ragged}) {
    std::string text;
    EXPECT_EQ(code_of_scan(file("more.ply", bytes), &text), "C05") << bytes;
    EXPECT_NE(text.find("promises 1 elements 'vertex', the file holds 3"), std::string::npos) << text;
    EXPECT_NE(text.find("hint: "), std::string::npos) << text;
  }
}

TEST_F(ScanPly, refuses_more_points_than_promised_before_other_elements) {
  const std::string ids = vertex(2) + "element id 1\nproperty int n\n";
  EXPECT_EQ(code_of_scan(file("b.ply", header("binary_little_endian", ids) + three_points<float>(false) +
                                           bytes_of_value(std::int32_t{1}))),
            "C05");
  EXPECT_EQ(code_of_scan(file("a.ply", header("ascii", ids) + "1 2 3\n4 5 6\n7 8 9\n1\n2 2 2\n")), "C05");
}

TEST_F(ScanPly, warns_of_stray_bytes_behind_the_points_and_reads_what_is_promised) {
  for (const std::string& bytes :
       {header("ascii", vertex(3)) + "1 2 3\n4 5 6\n7 8 9\nmade by hand\n",
        header("binary_little_endian", vertex(3)) + three_points<float>(false) + "\n"}) {
    const auto reader = open_scan(file("stray.ply", bytes));
    expect_one_to_nine(read_all(*reader));
    EXPECT_EQ(reader->warnings().size(), 1U) << bytes;
  }
  const std::string faces = vertex(3) + "element face 1\nproperty list uchar int i\n";
  for (const std::string& bytes :
       {header("ascii", vertex(3)) + "1 2 3\n4 5 6\n7 8 9\n\n \n",
        header("ascii", faces) + "1 2 3\n4 5 6\n7 8 9\n3 0 1 2\n",
        header("binary_little_endian", faces) + three_points<float>(false) + std::string("\0", 1)}) {
    const auto reader = open_scan(file("clean.ply", bytes));
    expect_one_to_nine(read_all(*reader));
    EXPECT_TRUE(reader->warnings().empty()) << reader->warnings().front();
  }
}

TEST_F(ScanPly, reads_ascii_whose_lines_end_with_carriage_returns) {
  std::string bytes = header("ascii", vertex(3)) + "1 2 3\n4 5 6\n7 8 9\n";
  std::replace(bytes.begin(), bytes.end(), '\n', '\r');
  expect_one_to_nine(read_all(*open_scan(file("cr.ply", bytes))));
}

TEST_F(ScanPly, reads_binary_points_behind_a_header_of_carriage_returns_whatever_their_first_byte) {
  std::string head =
      header("binary_little_endian", vertex(1, "property char x\nproperty char y\nproperty char z\n"));
  std::replace(head.begin(), head.end(), '\n', '\r');
  const ScanBlock block = read_all(*open_scan(file("crb.ply", head + "\n\x02\x03")));
  EXPECT_EQ(block.x, (std::vector<double>{10}));
  EXPECT_EQ(block.z, (std::vector<double>{3}));
}

TEST_F(ScanPly, reads_ascii_saved_as_utf16_and_refuses_binary_saved_so) {
  const std::string text = header("ascii", vertex(3)) + "1 2 3\n4 5 6\n7 8 9\n";
  expect_one_to_nine(read_all(*open_scan(file("w.ply", utf16(text, true)))));
  expect_one_to_nine(read_all(*open_scan(file("m.ply", "\xef\xbb\xbf" + text))));
  EXPECT_EQ(
      code_of_scan(file("x.ply", utf16(header("binary_little_endian", vertex(1)) + "123456789012", false))),
      "C04");
}

TEST_F(ScanPly, refuses_a_header_without_points) {
  EXPECT_EQ(code_of_scan(file("h.ply", header("binary_little_endian", vertex(5)))), "C06");
  EXPECT_EQ(code_of_scan(file("h0.ply", header("ascii", vertex(0)))), "C06");
  const std::string cut = header("ascii", vertex(5));
  EXPECT_EQ(code_of_scan(file("hn.ply", cut.substr(0, cut.size() - 1))), "C06");
}

TEST_F(ScanPly, refuses_headers_it_cannot_follow_and_names_the_line) {
  std::string text;
  EXPECT_EQ(
      code_of_scan(file("b1.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n1"),
                   &text),
      "C04");
  EXPECT_NE(text.find("header line 4"), std::string::npos) << text;
  EXPECT_EQ(code_of_scan(file("b2.ply", "ply\nformat xml 1.0\nend_header\n1")), "C04");
  EXPECT_EQ(code_of_scan(file("b3.ply", "ply\nelement vertex 1\n" + kFloatVertex + "end_header\n1")), "C04");
  EXPECT_EQ(code_of_scan(file("b4.ply", header("ascii", "element face 1\nproperty int x\n") + "1\n")), "C04");
  EXPECT_EQ(code_of_scan(
                file("b5.ply", header("ascii", vertex(1, "property float x\nproperty float y\n")) + "1 2\n")),
            "C04");
  EXPECT_EQ(code_of_scan(file("b6.ply", header("ascii", "element vertex many\n" + kFloatVertex) + "1 2 3\n")),
            "C04");
  EXPECT_EQ(code_of_scan(file("b7.ply", header("ascii", "property float x\n") + "1 2 3\n")), "C04");
  EXPECT_EQ(code_of_scan(file("b8.ply",
                              header("ascii", vertex(1, kFloatVertex + "property float x\n")) + "1 2 3 4\n")),
            "C04");
}

TEST_F(ScanPly, names_the_line_of_an_ascii_vertex_that_is_none) {
  std::string text;
  EXPECT_EQ(code_of_scan(file("w.ply", header("ascii", vertex(3)) + "1 2 3\n4 five 6\n7 8 9\n"), &text),
            "C08");
  EXPECT_NE(text.find("line 10"), std::string::npos) << text;
}

TEST_F(ScanPly, takes_scanner_positions_from_comments) {
  const std::string head = "comment station 1 2 3\n" + vertex(3);
  const auto reader =
      open_scan(file("s.ply", header("binary_little_endian", head) + three_points<float>(false)));
  ASSERT_EQ(reader->stations().size(), 1U);
  EXPECT_EQ(reader->stations()[0], Vec3(1, 2, 3));
}

TEST_F(ScanPly, knows_how_coarse_floats_are_far_from_the_origin) {
  const auto floats =
      open_scan(file("f.ply", header("binary_little_endian", vertex(3)) + three_points<float>(false)));
  EXPECT_DOUBLE_EQ(floats->resolution(1e6), 0.0625);
  const std::string properties = "property double x\nproperty double y\nproperty double z\n";
  const auto doubles = open_scan(
      file("d.ply", header("binary_little_endian", vertex(3, properties)) + three_points<double>(false)));
  EXPECT_EQ(doubles->resolution(1e6), 0);
}

}  // namespace
}  // namespace roomcut::testing
