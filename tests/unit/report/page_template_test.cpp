// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/report/page_template.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <stdexcept>

namespace roomcut::report {
namespace {

std::string gunzipped(const std::string& packed, std::size_t size) {
  std::string bytes(size, '\0');
  z_stream stream{};
  inflateInit2(&stream, 15 + 16);
  std::string input = packed;
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  EXPECT_EQ(stream.total_out, size);
  inflateEnd(&stream);
  return bytes;
}

TEST(PageTemplate, gzip_gives_back_what_it_was_given) {
  std::string bytes;
  for (int i = 0; i < 100000; ++i) {
    bytes += static_cast<char>(i % 251 * (i % 251) % 251);
  }
  EXPECT_LT(gzip(bytes).size(), bytes.size());
  EXPECT_EQ(gunzipped(gzip(bytes), bytes.size()), bytes);
  EXPECT_EQ(gunzipped(gzip(""), 0), "");
}

TEST(PageTemplate, gzip_names_no_time) {
  const std::string packed = gzip("wall");
  EXPECT_EQ(packed.substr(4, 4), std::string(4, '\0'));  // RFC 1952: MTIME
}

TEST(PageTemplate, blocks_take_the_place_of_the_mark_one_a_line) {
  const std::string page =
      fill_template("<body><!--roomcut-data--></body>", {{"run", "first"}, {"slice-0", "second"}});
  EXPECT_TRUE(page.starts_with("<body><script type=\"application/octet-stream\" id=\"block-run\">"));
  EXPECT_TRUE(page.ends_with("</script>\n</body>"));
  EXPECT_NE(page.find("</script>\n<script type=\"application/octet-stream\" id=\"block-slice-0\">"),
            std::string::npos);
  EXPECT_EQ(page.find("roomcut-data"), std::string::npos);
}

TEST(PageTemplate, refuses_a_template_without_place_for_data) {
  EXPECT_THROW(fill_template("<body></body>", {}), std::invalid_argument);
}

}  // namespace
}  // namespace roomcut::report
