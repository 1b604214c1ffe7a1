// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "common/picture/image.h"

namespace roomcut {

/// Dark blue to yellow, evenly perceived and safe for colour-blind readers (shape of viridis); t is clamped
/// to 0 … 1.
Colour sequential_colour(double t);
/// Blue over white to orange for t from -1 to 1.
Colour diverging_colour(double t);
/// Eight colours that colour-blind readers can tell apart (Okabe and Ito 2008); index is taken modulo 8.
Colour categorical_colour(int index);
struct NamedColour {
  const char* name;
  Colour colour;
};
/// What the three are made of, for those who draw themselves (the report's page): the eight, and the evenly
/// spaced colours between which the scales are linear.
std::span<const NamedColour> categorical_colours();
std::span<const Colour> sequential_stops();
std::span<const Colour> diverging_stops();
/// "#rrggbb"
std::string hex(Colour colour);

}  // namespace roomcut
