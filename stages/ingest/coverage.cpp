// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/coverage.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace roomcut::ingest {

namespace {

constexpr int kTableSize = 128;

/// Mean points per covered cell, when `ratio` is the mean over the filled ones (Poisson without its zeros):
/// solves mean / (1 - exp(-mean)) = ratio.
double mean_with_empties(double ratio) {
  if (ratio <= 1) {
    return 0;
  }
  double mean = 2 * (ratio - 1) < ratio ? 2 * (ratio - 1) : ratio;
  for (int i = 0; i < 50; ++i) {
    mean = ratio * (1 - std::exp(-mean));  // contracts for ratio > 1
  }
  return mean;
}

Covered compute_covered(std::uint32_t points, int filled) {
  const double empty_share = std::exp(-static_cast<double>(points) / 9);
  const double expected = 9 * empty_share;
  const double deviation = std::sqrt(9 * empty_share * (1 - empty_share));
  if (9 - filled <= expected + 3 * deviation) {
    return {9, true};
  }
  const double mean = mean_with_empties(static_cast<double>(points) / filled);
  const double cells = mean > 0 ? filled / (1 - std::exp(-mean)) : 9;
  return {std::clamp(cells, static_cast<double>(filled), 9.0), false};
}

using Table = std::array<std::array<Covered, 10>, kTableSize>;

Table make_table() {
  Table table{};
  for (std::uint32_t points = 1; points < kTableSize; ++points) {
    for (int filled = 1; filled <= 9; ++filled) {
      table[points][static_cast<std::size_t>(filled)] = compute_covered(points, filled);
    }
  }
  return table;
}

}  // namespace

unsigned projected(VoxelMask mask, int axis) {
  unsigned seen = 0;
  for (unsigned i = 0; i < 3; ++i) {
    if (axis == 0) {  // columns i, i + 3, i + 6 differ in y; all x of a row fall together
      const unsigned row = mask >> (9 * i) & 0x1ff;
      seen |= ((row | row >> 3 | row >> 6) & 7) << (3 * i);
    } else if (axis == 1) {
      seen |= mask >> (9 * i) & 0x1ff;
    }
  }
  if (axis == 2) {
    const unsigned any = mask | mask >> 1 | mask >> 2;
    for (unsigned column = 0; column < 9; ++column) {
      seen |= (any >> (3 * column) & 1) << column;
    }
  }
  return seen;
}

Covered covered_cells(std::uint32_t points, int filled) {
  static const Table kTable = make_table();
  filled = std::clamp(filled, 1, 9);
  if (points >= kTableSize) {
    return {static_cast<double>(filled), filled == 9};
  }
  return kTable[std::max<std::uint32_t>(points, 1)][static_cast<std::size_t>(filled)];
}

double chord_of_square(double nx, double ny, double d) {
  constexpr double kHalf = 1.5;
  const double c = std::max(std::abs(nx), std::abs(ny));
  const double s = std::min(std::abs(nx), std::abs(ny));
  d = std::abs(d);
  const double whole = 2 * kHalf / c;
  if (d <= kHalf * (c - s)) {
    return whole;
  }
  return std::clamp((kHalf * (c + s) - d) / (c * s), 1.0, whole);
}

}  // namespace roomcut::ingest
