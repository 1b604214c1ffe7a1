// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/split_lines.h"

#include <gtest/gtest.h>

#include "tests/unit/refine_lines/made_points.h"

namespace roomcut::refine_lines {
namespace {

using testing::Normal;

constexpr double kNoise_m = 0.001;  ///< of an observation
constexpr double kApart_m = 0.005;
const LinePrior kPrior{0.06, 0.5 * testing::kDeg};

/// A line of 10 m in two storeys, with a gap of 20 cm at 5 m where another wall meets it.
LineFaces faces_of_two_rooms() {
  LineFaces faces;
  faces.line = {0.3, 2.0};
  faces.t1 = 10;
  faces.bins = 100;
  faces.bin_m = 0.1;
  faces.layers = 3;  // storey, slab, storey
  faces.side.assign(300, 1);
  for (std::size_t bin = 0; bin < 100; ++bin) {
    faces.side[bin * 3 + 1] = 0;
    if (bin == 49 || bin == 50) {
      faces.side[bin * 3] = faces.side[bin * 3 + 2] = 0;
    }
  }
  faces.area_m2 = 49;
  return faces;
}

/// `offset(bin, layer)`: where the wall really is, from the line.
template <class Offset>
std::vector<Observation> observed(const LineFaces& faces, Normal& random, Offset offset) {
  std::vector<Observation> observations;
  for (const std::size_t layer : {0U, 2U}) {
    for (std::size_t bin = 0; bin < faces.bins; ++bin) {
      if (faces.side_at(bin, layer) != 0) {
        const Vec2 p = faces.line.at((static_cast<double>(bin) + 0.5) * faces.bin_m) +
                       (offset(bin, layer) + random(kNoise_m)) * faces.line.normal();
        observations.push_back({p, kNoise_m * kNoise_m, 9e-6, 30, static_cast<int>(layer), bin, layer});
      }
    }
  }
  return observations;
}

std::vector<LinePart> split(const LineFaces& faces, const std::vector<Observation>& observations) {
  return split_line(faces, observations, {2.5, 0.3, 2.4}, kPrior, kApart_m);
}

TEST(SplitLines, WallsInOnePlaneStayOneLineWhateverTheNoise) {
  const LineFaces faces = faces_of_two_rooms();
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Normal random(seed);
    const auto parts = split(faces, observed(faces, random, [](std::size_t, std::size_t) { return 0.004; }));
    ASSERT_EQ(parts.size(), 1U) << seed;
    EXPECT_EQ(parts[0].observations.size(), 196U);
  }
}

TEST(SplitLines, WallsInARowThatDifferByEightMillimetresBecomeTwo) {
  const LineFaces faces = faces_of_two_rooms();
  Normal random(2);
  const auto parts = split(
      faces, observed(faces, random, [](std::size_t bin, std::size_t) { return bin < 50 ? -0.004 : 0.004; }));
  ASSERT_EQ(parts.size(), 2U);
  for (const LinePart& part : parts) {
    EXPECT_EQ(part.observations.size(), 98U);
    EXPECT_NEAR(part.faces.t1 - part.faces.t0, 5.0,
                1e-9);  // to the middle of the gap: a wall may have been missed there
    EXPECT_NEAR(part.faces.area_m2, 4.9 * 4.9, 0.01);
    EXPECT_EQ(part.faces.side.size(), part.faces.bins * 3);
    EXPECT_EQ(part.faces.side_at(3, 0), 1);
    EXPECT_EQ(part.faces.side_at(3, 1), 0);
    EXPECT_EQ(levels_of(part, std::nullopt), std::nullopt) << "both are walls of both storeys";
  }
}

TEST(SplitLines, WallsAboveEachOtherBecomeTwoThatKeepTheirOwnStorey) {
  const LineFaces faces = faces_of_two_rooms();
  Normal random(3);
  const auto parts = split(
      faces, observed(faces, random, [](std::size_t, std::size_t layer) { return layer == 0 ? 0.0 : 0.03; }));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].faces.side_at(3, 0), 1);
  EXPECT_EQ(parts[0].faces.side_at(3, 2), 0);
  EXPECT_EQ(parts[1].faces.side_at(3, 0), 0);
  EXPECT_EQ(parts[1].faces.side_at(3, 2), 1);
  EXPECT_EQ(parts[0].layers, (std::vector<int>{0, 1}));  // no wall in the slab: it could be either's
  EXPECT_EQ(parts[1].layers, (std::vector<int>{1, 2}));
  EXPECT_EQ(levels_of(parts[0], std::nullopt), parts[0].layers);
  EXPECT_EQ(levels_of(parts[0], std::vector<int>{0, 2}), std::vector<int>{0});
}

TEST(SplitLines, ALineThatIsOnlyTurnedIsNotSplit) {
  const LineFaces faces = faces_of_two_rooms();
  Normal random(4);
  const auto parts = split(faces, observed(faces, random, [](std::size_t bin, std::size_t) {
                             return 0.002 * (static_cast<double>(bin) * 0.1 - 5);
                           }));
  EXPECT_EQ(parts.size(), 1U);
}

TEST(SplitLines, AWallWithFewObservationsGoesWithItsNeighbour) {
  const LineFaces faces = faces_of_two_rooms();
  Normal random(5);
  std::vector<Observation> some =
      observed(faces, random, [](std::size_t bin, std::size_t) { return bin < 50 ? 0.0 : 0.01; });
  std::erase_if(some, [](const Observation& o) { return o.layer == 2 && o.bin > 50 && o.bin % 10 != 0; });
  const auto parts = split(faces, some);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].observations.size() + parts[1].observations.size(), some.size());
}

}  // namespace
}  // namespace roomcut::refine_lines
