// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/line_neighbourhood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/random/counter_random.h"

namespace roomcut::refine_lines {
namespace {

constexpr double kBand_m = 0.06;

double unit(std::uint64_t stream, std::uint64_t k) {
  return random_unit(7, stream, k);
}

TEST(LineNeighbourhood, NamesEveryLineThatAPointMayLieOnAndFewOthers) {
  std::vector<LineFaces> faces(40);
  std::vector<LineTrack> tracks(faces.size());
  std::vector<NearLine> lines;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    faces[i].line = {std::numbers::pi * unit(1, i), 8 * unit(2, i) - 2};
    faces[i].t0 = 10 * unit(3, i) - 5;
    faces[i].t1 = faces[i].t0 + 6 * unit(4, i);
    tracks[i].line = i;
    lines.push_back({&tracks[i], &faces[i], faces[i].line.normal(), faces[i].line.direction()});
  }
  CloudTile tile;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    // Some lie on the rims of the blocks.
    const double x = i % 10 == 0 ? 0.5 * std::floor(12 * unit(5, i)) : 6.4 * unit(5, i);
    tile.x.push_back(static_cast<float>(x));
    tile.y.push_back(static_cast<float>(6.4 * unit(6, i)));
  }
  tile.z.resize(tile.x.size());
  const LineNeighbourhood neighbourhood(tile, lines, kBand_m);
  std::size_t asked = 0;
  for (std::size_t i = 0; i < tile.x.size(); ++i) {
    const auto near = neighbourhood.near(tile.x[i], tile.y[i]);
    asked += near.size();
    EXPECT_TRUE(std::is_sorted(near.begin(), near.end(), [](const NearLine& a, const NearLine& b) {
      return a.track->line < b.track->line;
    }));
    const Vec2 p(tile.x[i], tile.y[i]);
    for (const NearLine& line : lines) {
      const double t = line.direction.dot(p);
      const bool on_it = std::abs(line.normal.dot(p) - line.faces->line.d) < kBand_m && t >= line.faces->t0 &&
                         t < line.faces->t1;
      const bool named = std::any_of(near.begin(), near.end(),
                                     [&](const NearLine& other) { return other.track == line.track; });
      ASSERT_TRUE(!on_it || named) << "point " << i << ", line " << line.track->line;
    }
  }
  EXPECT_LT(static_cast<double>(asked) / static_cast<double>(tile.x.size()),
            0.2 * static_cast<double>(lines.size()));
}

TEST(LineNeighbourhood, IsEmptyWithoutPointsOrLines) {
  EXPECT_TRUE(LineNeighbourhood({}, {}, kBand_m).empty());
}

}  // namespace
}  // namespace roomcut::refine_lines
