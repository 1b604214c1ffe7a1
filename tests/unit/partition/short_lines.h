// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "common/wall_lines/wall_line.h"

namespace roomcut::partition {

/// How the lines of short_lines() lie to each other.
enum class ShortLines {
  kScattered,     ///< half along x or y, half at any angle
  kNearParallel,  ///< turned against one of two directions by 1e-7 … 1e-2 rad
  kSmallAngles,   ///< crossing an earlier line at 1e-6 … 1e-2 rad
  kCollinear,     ///< in a row with one of six lines, to within 1e-4 m and 1e-3 rad; some overlap
  kJunctions,     ///< ending on an earlier line, to within 2e-5 m
  kColumns,       ///< sides of columns in rows, each moved and turned by what a fit would err
};
inline constexpr std::array kShortLineFamilies = {ShortLines::kScattered,   ShortLines::kNearParallel,
                                                  ShortLines::kSmallAngles, ShortLines::kCollinear,
                                                  ShortLines::kJunctions,   ShortLines::kColumns};

/// `count` lines of 0.3 … 3 m (columns: 0.24 … 0.5 m) in a plan of 40 x 30 m, their coordinates rounded to 6
/// decimals as wall_lines.geojson stores them. Pure function of its arguments.
WallLines short_lines(ShortLines family, std::uint64_t seed, int count);

}  // namespace roomcut::partition
