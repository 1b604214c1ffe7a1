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

constexpr std::array<Colour, 6> kSequential{
    {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
constexpr std::array<Colour, 3> kDiverging{{{0, 114, 178}, {247, 247, 247}, {213, 94, 0}}};
constexpr std::array<NamedColour, 8> kCategorical{{{"blue", {0, 114, 178}},
                                                   {"orange", {230, 159, 0}},
                                                   {"green", {0, 158, 115}},
                                                   {"pink", {204, 121, 167}},
                                                   {"sky", {86, 180, 233}},
                                                   {"vermilion", {213, 94, 0}},
                                                   {"yellow", {240, 228, 66}},
                                                   {"grey", {90, 90, 90}}}};

}  // namespace

Colour sequential_colour(double t) {
  const double at = std::clamp(t, 0.0, 1.0) * (kSequential.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kSequential.size() - 2);
  return mix(kSequential[below], kSequential[below + 1], at - static_cast<double>(below));
}

Colour diverging_colour(double t) {
  const double at = std::clamp(t, -1.0, 1.0);
  return mix(kDiverging[1], kDiverging[at < 0 ? 0 : 2], std::abs(at));
}

Colour categorical_colour(int index) {
  const int count = static_cast<int>(kCategorical.size());
  return kCategorical[static_cast<std::size_t>(((index % count) + count) % count)].colour;
}

std::span<const NamedColour> categorical_colours() {
  return kCategorical;
}

std::span<const Colour> sequential_stops() {
  return kSequential;
}

std::span<const Colour> diverging_stops() {
  return kDiverging;
}

std::string hex(Colour colour) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour.r, colour.g, colour.b);
  return text.data();
}

}  // namespace roomcut
