// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/picture/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace roomcut {

namespace {

std::uint8_t mix(std::uint8_t a, std::uint8_t b, double t) {
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * t));
}

Colour mix(Colour a, Colour b, double t) {
  return {mix(a.r, b.r, t), mix(a.g, b.g, t), mix(a.b, b.b, t)};
}

}  // namespace

Colour sequential_colour(double t) {
  static constexpr std::array<Colour, 6> kStops{
      {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
  const double at = std::clamp(t, 0.0, 1.0) * (kStops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  return mix(kStops[below], kStops[below + 1], at - static_cast<double>(below));
}

Colour diverging_colour(double t) {
  constexpr Colour kLow{0, 114, 178}, kMiddle{247, 247, 247}, kHigh{213, 94, 0};
  const double at = std::clamp(t, -1.0, 1.0);
  return at < 0 ? mix(kMiddle, kLow, -at) : mix(kMiddle, kHigh, at);
}

Colour categorical_colour(int index) {
  static constexpr std::array<Colour, 8> kColours{{{0, 114, 178},
                                                   {230, 159, 0},
                                                   {0, 158, 115},
                                                   {204, 121, 167},
                                                   {86, 180, 233},
                                                   {213, 94, 0},
                                                   {240, 228, 66},
                                                   {90, 90, 90}}};
  const int count = static_cast<int>(kColours.size());
  return kColours[static_cast<std::size_t>(((index % count) + count) % count)];
}

std::string hex(Colour colour) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour.r, colour.g, colour.b);
  return text.data();
}

}  // namespace roomcut
