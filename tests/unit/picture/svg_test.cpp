// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/picture/svg.h"

#include <gtest/gtest.h>

#include <string>

#include "common/picture/colour_map.h"

namespace roomcut {
namespace {

TEST(Svg, FlipsYOnceAndScales) {
  Svg svg({1, 2}, {11, 7}, 10);
  svg.line({1, 2}, {11, 7}, {0, 0, 0}, 1);
  EXPECT_NE(svg.str().find("x1=\"0.00\" y1=\"50.00\" x2=\"100.00\" y2=\"0.00\""), std::string::npos)
      << svg.str();
}

TEST(Svg, EscapesWords) {
  Svg svg({0, 0}, {1, 1}, 10);
  svg.text({0, 0}, "a<b & \"c\"", 10, {0, 0, 0});
  EXPECT_NE(svg.str().find("a&lt;b &amp; &quot;c&quot;"), std::string::npos);
}

TEST(Svg, Base64HasThePaddingOfTheStandard) {
  const std::string words[] = {"f", "fo", "foo", "foob"};
  const char* expected[] = {"Zg==", "Zm8=", "Zm9v", "Zm9vYg=="};
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(base64({reinterpret_cast<const std::uint8_t*>(words[i].data()), words[i].size()}), expected[i]);
  }
}

TEST(ColourMap, RunsBetweenItsEndsAndClamps) {
  EXPECT_EQ(sequential_colour(-1), sequential_colour(0));
  EXPECT_EQ(sequential_colour(2), sequential_colour(1));
  EXPECT_EQ(hex(diverging_colour(0)), "#f7f7f7");
  EXPECT_EQ(categorical_colour(8), categorical_colour(0));
  EXPECT_EQ(categorical_colour(-1), categorical_colour(7));
}

}  // namespace
}  // namespace roomcut
