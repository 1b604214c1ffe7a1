// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/picture/render.h"

#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cstring>
#include <map>
#include <numbers>

namespace roomcut {
namespace {

constexpr Colour kLow{200, 0, 0}, kHigh{0, 200, 0};

/// Two unit squares at z = 0 and z = 1, both with the normal down.
Drawing two_squares() {
  Drawing drawing;
  for (const double z : {0.0, 1.0}) {
    const auto first = static_cast<std::int32_t>(drawing.vertices.size());
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
      drawing.vertices.emplace_back(x, y, z);
    }
    drawing.triangles.push_back({first, first + 2, first + 1});
    drawing.triangles.push_back({first, first + 3, first + 2});
    drawing.triangle_colours.insert(drawing.triangle_colours.end(), 2, z == 0 ? kLow : kHigh);
  }
  return drawing;
}

View plan_view() {
  View view;
  view.azimuth = -std::numbers::pi / 2;
  view.elevation = std::numbers::pi / 2;
  view.width = view.height = 50;
  view.edges = view.shade = false;
  return view;
}

TEST(Render, TheNearerSurfaceHidesTheFartherOne) {
  EXPECT_EQ(render(two_squares(), plan_view()).get(25, 25), kHigh);
  View from_below = plan_view();
  from_below.elevation *= -1;
  from_below.look_inside = false;
  EXPECT_EQ(render(two_squares(), from_below).get(25, 25), kLow);
}

TEST(Render, LookingInsideLeavesOutWhatFacesTheEye) {
  Drawing drawing = two_squares();
  std::swap(drawing.triangles[2][0], drawing.triangles[2][1]);  // the upper square now faces the eye
  std::swap(drawing.triangles[3][0], drawing.triangles[3][1]);
  EXPECT_EQ(render(drawing, plan_view()).get(25, 25), kLow);
}

TEST(Render, PlanHasXToTheRightAndYUp) {
  Drawing drawing;
  drawing.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  drawing.point_colours = {{0, 0, 0}, {255, 0, 0}, {0, 0, 255}};
  View view = plan_view();
  view.point_size = 3;
  const Image image = render(drawing, view);
  EXPECT_EQ(image.get(49, 49), (Colour{255, 0, 0}));
  EXPECT_EQ(image.get(2, 2), (Colour{0, 0, 255}));
}

TEST(Render, PointsThatAreNotSmoothedKeepTheirColours) {
  Drawing drawing;
  drawing.points = {{0, 0, 0}, {1, 1, 0}};
  drawing.point_colours = {{10, 20, 30}, {200, 0, 0}};
  View view = plan_view();
  view.width = view.height = 33;  // an odd number of rows, and more than are drawn together
  view.smooth = false;
  const Image image = render(drawing, view);
  std::map<std::array<int, 3>, int> count;
  for (const Colour c : image.pixels()) {
    ++count[{c.r, c.g, c.b}];
  }
  EXPECT_EQ(count, (std::map<std::array<int, 3>, int>{
                       {{10, 20, 30}, 1}, {{200, 0, 0}, 1}, {{255, 255, 255}, 33 * 33 - 2}}));
}

/// The picture that libpng reads from the bytes of a file.
std::vector<std::uint8_t> decoded(const std::vector<std::uint8_t>& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()), 0);
  png.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
  EXPECT_NE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr), 0);
  return pixels;
}

TEST(EncodePng, KeepsEveryPixelWithAPaletteAndWithout) {
  for (const int colours : {1, 2, 255, 256, 257, 5000}) {
    Image image(100, 60);
    for (int i = 0; i < 6000; ++i) {
      const int c = i % colours;
      image.set(i % 100, i / 100,
                {static_cast<std::uint8_t>(c), static_cast<std::uint8_t>(c / 256),
                 static_cast<std::uint8_t>(c * 7)});
    }
    const auto bytes = encode_png(image);
    const auto pixels = decoded(bytes);
    ASSERT_EQ(pixels.size(), 3 * image.pixels().size());
    EXPECT_EQ(std::memcmp(pixels.data(), image.pixels().data(), pixels.size()), 0) << colours << " colours";
    constexpr std::size_t kColourType = 25;  // of the header: 3 = palette, 2 = red, green, blue
    EXPECT_EQ(bytes[kColourType], colours <= 256 ? 3 : 2);
    const auto plain = encode_png(image, PngPixels::kRgb);
    EXPECT_EQ(plain[kColourType], 2);
    EXPECT_EQ(decoded(plain), pixels);
  }
}

TEST(Render, EqualPicturesGiveEqualPngBytes) {
  const auto bytes = encode_png(render(two_squares(), plan_view()));
  EXPECT_EQ(bytes, encode_png(render(two_squares(), plan_view())));
  ASSERT_GT(bytes.size(), 8U);
  EXPECT_EQ(bytes[1], 'P');
}

}  // namespace
}  // namespace roomcut
