// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "common/picture/svg.h"
#include "stages/tools/report/pictures.h"
#include "tests/unit/report/count.h"

namespace roomcut::report {
namespace {

TEST(Captioned, a_drawing_keeps_its_content_below_title_and_caption) {
  Svg svg({0, 0}, {10, 5}, 60);
  svg.line({0, 0}, {1, 1}, {1, 2, 3}, 2);
  const std::string text = captioned({"slice", "a.svg", "A <title>", "What is seen.", svg.str()});
  EXPECT_NE(text.find(svg.str()), std::string::npos);
  EXPECT_NE(text.find("A &lt;title&gt;"), std::string::npos);
  EXPECT_NE(text.find("What is seen."), std::string::npos);
  EXPECT_NE(text.find("width=\"625\""), std::string::npos) << text.substr(0, 200);
}

TEST(Captioned, a_raster_is_put_in_at_its_own_size) {
  const auto png = encode_png(Image(700, 30));
  const std::string text = captioned({"extract", "model.png", "Model", "Seen.", {png.begin(), png.end()}});
  EXPECT_NE(text.find("<image width=\"700\" height=\"30\" href=\"data:image/png;base64," + base64(png)),
            std::string::npos);
}

TEST(Captioned, a_long_caption_is_broken_into_rows) {
  std::string caption;
  for (int i = 0; i < 60; ++i) {
    caption += "word" + std::to_string(i) + " ";
  }
  const Svg svg({0, 0}, {1, 1}, 400);
  const std::string text = captioned({"slice", "a.svg", "Title", caption, svg.str()});
  EXPECT_GT(count(text, "<text"), 4U);
  EXPECT_EQ(count(text, "word"), 60U);
}

}  // namespace
}  // namespace roomcut::report
