// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "scan_files.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

using ScanPcd = ScanFiles;

std::string header(const std::string& fields, const std::string& sizes, const std::string& types,
                   std::size_t points, const std::string& data, const std::string& more = "") {
  return "VERSION .7\nFIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " + types + "\n" + more + "WIDTH " +
         std::to_string(points) + "\nHEIGHT 1\nPOINTS " + std::to_string(points) + "\nDATA " + data + "\n";
}

void expect_points(const ScanBlock& block) {
  EXPECT_EQ(block.x, (std::vector<double>{1, 4, 7}));
  EXPECT_EQ(block.y, (std::vector<double>{2, 5, 8}));
  EXPECT_EQ(block.z, (std::vector<double>{3, 6, 9}));
}

/// Three points of y (uint8), three bytes of something, x (float), z (double), as records.
std::string records() {
  std::string bytes;
  for (int i = 0; i < 3; ++i) {
    bytes += bytes_of_value(static_cast<std::uint8_t>(3 * i + 2)) + "abc" +
             bytes_of_value(static_cast<float>(3 * i + 1)) + bytes_of_value(static_cast<double>(3 * i + 3));
  }
  return bytes;
}

std::string binary_header(const std::string& data, std::size_t points = 3) {
  return header("y other x z", "1 1 4 8", "U U F F", points, data, "COUNT 1 3 1 1\n");
}

/// The same, column by column.
std::string columns() {
  std::string y, x, z;
  for (int i = 0; i < 3; ++i) {
    y += bytes_of_value(static_cast<std::uint8_t>(3 * i + 2));
    x += bytes_of_value(static_cast<float>(3 * i + 1));
    z += bytes_of_value(static_cast<double>(3 * i + 3));
  }
  return y + "aaaaaaaaa" + x + z;
}

/// LZF of `bytes` as literals, but for a run of equal bytes, which repeats itself.
std::string lzf(const std::string& bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size();) {
    const std::size_t run = std::min(bytes.find_first_not_of(bytes[i], i), bytes.size()) - i;
    out += std::string{'\0', bytes[i++]};
    if (run >= 10) {  // a back reference by one byte, of 9 + n more
      const std::size_t more = std::min<std::size_t>(run - 1, 264);
      out += std::string{'\xe0', static_cast<char>(more - 9), '\0'};
      i += more;
    } else if (run >= 4) {
      out += std::string{static_cast<char>((run - 3) << 5), '\0'};
      i += run - 1;
    }
  }
  return out;
}

std::string compressed(const std::string& bytes, std::uint32_t claimed) {
  const std::string packed = lzf(bytes);
  return bytes_of_value(static_cast<std::uint32_t>(packed.size())) + bytes_of_value(claimed) + packed;
}

class WithScratch : public ScanPcd {
 protected:
  std::unique_ptr<ScanReader> open(const std::string& bytes) {
    return open_scan(file("s.pcd", bytes), {{}, folder()});
  }
  std::string code(const std::string& bytes, std::string* text = nullptr) {
    return code_of([&] { read_all(*open(bytes)); }, text);
  }
};

TEST_F(WithScratch, is_read_whatever_its_first_line_and_the_order_of_its_header) {
  const std::string body = "1 2 3 .5\n4 5 6 .5\n7 8 9 .5\n";
  const std::string head = header("x y z intensity", "4 4 4 4", "F F F F", 3, "ascii");
  for (const std::string& begin :
       {std::string(), std::string("# .PCD v0.7\n"), std::string("#.PCD\n\n# more\n")}) {
    expect_points(read_all(*open(begin + head + body)));
  }
  expect_points(read_all(*open("# any\nPOINTS 3\nFIELDS x y z\nDATA ascii\n1 2 3\n4 5 6\n7 8 9")));
  expect_points(read_all(*open(utf16(head + body, false))));
}

TEST_F(WithScratch, reads_ascii_fields_by_name_and_count) {
  const std::string head =
      header("z hist y x", "4 4 4 4", "F F F F", 3, "ascii", "COUNT 1 3 1 1\nVIEWPOINT 1 2 3 1 0 0 0\n");
  const auto reader = open(head + "3 0 0 0 2 1\n6 0 0 0 5 4\n9 0 0 0 8 7\n");
  expect_points(read_all(*reader));
  EXPECT_EQ(reader->stations(), std::vector<Vec3>{Vec3(1, 2, 3)});
  const auto turned =
      open(header("x y z", "4 4 4", "F F F", 1, "ascii", "VIEWPOINT 1 2 3 0 1 0 0\n") + "nan 2 3\n");
  EXPECT_TRUE(turned->stations().empty()) << "what a rotation means is not agreed";
  EXPECT_TRUE(std::isnan(read_all(*turned).x[0]));
}

TEST_F(WithScratch, reads_binary_records_and_compressed_columns) {
  expect_points(read_all(*open(binary_header("binary") + records())));
  expect_points(read_all(*open(binary_header("binary_compressed") + compressed(columns(), 48))));
}

TEST_F(WithScratch, reads_normals) {
  std::string bytes = header("x y z normal_x normal_y normal_z", "4 4 4 4 4 4", "F F F F F F", 1, "binary");
  for (const float value : {1.0F, 2.0F, 3.0F, 0.0F, 0.6F, 0.8F}) bytes += bytes_of_value(value);
  const auto reader = open(bytes);
  ASSERT_TRUE(reader->has_normals());
  EXPECT_EQ(read_all(*reader).nz, std::vector<float>{0.8F});
}

TEST_F(WithScratch, decompresses_long_runs_over_many_windows) {
  constexpr std::size_t kPoints = 300'000;
  const std::string head = header("x y z i", "4 4 4 4", "F F F F", kPoints, "binary_compressed");
  const std::string zeros(kPoints * 12, '\0');
  std::string last;
  for (std::size_t i = 0; i < kPoints; ++i) last += bytes_of_value(static_cast<float>(i));
  const auto reader =
      open_scan(file("z.pcd", header("i x y z", "4 4 4 4", "F F F F", kPoints, "binary_compressed") +
                                  compressed(zeros + last, 16 * kPoints)),
                {{}, folder()});
  const ScanBlock block = read_all(*reader);
  ASSERT_EQ(block.size(), kPoints);
  EXPECT_EQ(block.z[299'999], 299'999);
  EXPECT_EQ(block.x[150'000], 0);
}

TEST_F(WithScratch, refuses_other_numbers_of_points_than_promised) {
  const std::string head = header("x y z", "4 4 4", "F F F", 2, "ascii");
  EXPECT_EQ(code(head + "1 2 3\n"), "C05");
  EXPECT_EQ(code(head + "1 2 3\n4 5 6\n7 8 9\n"), "C05");
  EXPECT_EQ(code(binary_header("binary", 4) + records()), "C05");
  EXPECT_EQ(code(binary_header("binary", 2) + records()), "C05");
  for (const std::string data : {"ascii", "binary", "binary_compressed"}) {
    const std::string got = code(header("x y z", "4 4 4", "F F F", 4'000'000'000, data) + records());
    EXPECT_TRUE(got == "C05" || got == "C04") << data << got;
  }
  const auto stray = open(binary_header("binary") + records() + "\n");
  EXPECT_EQ(stray->warnings().size(), 1U);
}

TEST_F(WithScratch, takes_zeros_behind_binary_points_for_the_filled_up_page_of_PCL) {
  const auto padded = open(binary_header("binary") + records() + std::string(3856, '\0'));
  EXPECT_TRUE(padded->warnings().empty());
  expect_points(read_all(*padded));
  EXPECT_EQ(code(binary_header("binary") + records() + std::string(3855, '\0') + "x"), "C05");
  EXPECT_EQ(code(binary_header("binary") + records() + std::string(100'000, '\0')), "C05");
}

TEST_F(WithScratch, refuses_headers_it_cannot_follow_and_names_the_line) {
  std::string text;
  EXPECT_EQ(
      code("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 2\nPOINTS 3\nDATA ascii\n1 2 3\n", &text),
      "C04");
  EXPECT_NE(text.find("header line 7"), std::string::npos) << text;
  EXPECT_EQ(code("FIELDS x y z\nSIZE 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n"), "C04");
  EXPECT_EQ(code(header("x y i", "4 4 4", "F F F", 1, "ascii") + "1 2 3\n"), "C04");
  EXPECT_EQ(code(header("x y z x", "4 4 4 4", "F F F F", 1, "ascii") + "1 2 3 4\n"), "C04");
  EXPECT_EQ(code(header("x y z", "4 4 8", "F F I", 1, "binary") + std::string(16, '\0')), "C04");
  EXPECT_EQ(code(header("x y z", "4 4 3", "F F F", 1, "binary") + std::string(16, '\0')), "C04");
  EXPECT_EQ(code(header("x y z", "4 4 4", "F F F", 1, "base64") + "1 2 3\n"), "C04");
  EXPECT_EQ(code("# .PCD v.7\nFIELDS x y z\n"), "C05");
  EXPECT_EQ(code(header("x y z", "4 4 4", "F F F", 0, "ascii")), "C06");
}

TEST_F(WithScratch, refuses_damaged_compressed_points) {
  const std::string good = compressed(columns(), 48);
  EXPECT_EQ(code(binary_header("binary_compressed") + good.substr(0, good.size() - 3)), "C05");
  EXPECT_EQ(code(binary_header("binary_compressed") + compressed(columns(), 47)), "C04");
  EXPECT_EQ(code(binary_header("binary_compressed") + compressed(columns().substr(1), 48)), "C04");
  std::string far = good;
  far[8] = '\x20';  // a reference before the beginning
  EXPECT_EQ(code(binary_header("binary_compressed") + far), "C04");
  EXPECT_EQ(code(binary_header("binary_compressed") + "abc"), "C05");
}

}  // namespace
}  // namespace roomcut::testing
