// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/arc_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/wall_lines/wall_arc.h"
#include "tests/unit/robust/normal.h"

namespace roomcut::refine_lines {
namespace {

constexpr double kNoise_m = 0.0005;  // of an observation

/// Observations of a circle over `sweep` [rad], every tenth of them on something 4 cm before it.
std::vector<Observation> observed(const Vec2& centre, double radius, double from, double sweep, int count,
                                  std::uint64_t seed) {
  testing::Normal random(seed);
  std::vector<Observation> observations;
  for (int k = 0; k < count; ++k) {
    const double angle = from + sweep * (k + 0.5) / count;
    const double off = k % 10 == 7 ? -0.04 : random(kNoise_m);
    Observation o{};
    o.point = centre + (radius + off) * Vec2(std::cos(angle), std::sin(angle));
    o.variance_m2 = kNoise_m * kNoise_m;
    o.points = 40;
    o.bin = static_cast<std::size_t>(k);
    observations.push_back(o);
  }
  return observations;
}

std::vector<LineItem> chords(const WallArc& arc, int count) {
  std::vector<LineItem> items;
  for (int k = 0; k < count; ++k) {
    LineItem item;
    item.wall.id = "w" + std::to_string(k);
    const auto corner = [&](int i) -> Vec2 {
      return arc.centre + arc.radius_m * Vec2(std::cos(0.1 * i), std::sin(0.1 * i));
    };
    item.wall.a = corner(k);
    item.wall.b = corner(k + 1);
    set_arc(item.wall, arc, {});
    items.push_back(item);
  }
  return items;
}

TEST(ArcFit, RadiusAndCentreAreWithinTheirUncertaintyDespiteOutliers) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CircleFit came;
    came.centre = {2.01, -0.99};
    came.radius_m = 3.02;
    const CircleFit fit = fit_circle(came, {}, 0.06, observed({2, -1}, 3, 0.4, 1.5, 80, seed));
    ASSERT_TRUE(fit.usable);
    const double sigma = std::sqrt(fit.covariance(2, 2));
    EXPECT_LT(std::abs(fit.radius_m - 3), 4 * sigma) << seed;
    EXPECT_LT(sigma, 0.003) << seed;
    EXPECT_GT(sigma, 0.0002) << seed;
  }
}

TEST(ArcFit, TooFewObservationsLeaveTheCircleAsItCame) {
  CircleFit came;
  came.radius_m = 2;
  EXPECT_FALSE(fit_circle(came, {}, 0.06, observed({0, 0}, 2.1, 0, 1, 3, 1)).usable);
}

TEST(ArcFit, ChordsMoveTogetherAndStillMeet) {
  const WallArc came{"a0001", {0.01, 0.02}, 2.02};
  std::vector<LineItem> items = chords(came, 12);
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k != 5) items[k].observations = observed({0, 0}, 2, 0.1 * static_cast<double>(k), 0.1, 6, k + 1);
  }
  const std::vector<WallLine> refined = refine_arc(items, {}, 0.06);
  ASSERT_EQ(refined.size(), items.size());
  for (std::size_t k = 0; k < refined.size(); ++k) {  // the one without observations too
    EXPECT_NEAR(refined[k].a.norm(), 2, 0.004) << k;
    EXPECT_EQ(refined[k].source, LineSource::kRefined);
    EXPECT_NEAR(arc_of(refined[k], {})->radius_m, 2, 0.004);
    if (k > 0) {
      EXPECT_NEAR((refined[k].a - refined[k - 1].b).norm(), 0, 1e-9);
    }
  }
}

TEST(ArcFit, ALockedChordStaysAndStraightLinesAreLeft) {
  std::vector<LineItem> items = chords({"a0001", {0, 0}, 2.02}, 6);
  for (LineItem& item : items) item.observations = observed({0, 0}, 2, 0, 0.6, 20, 1);
  items[3].constant = true;
  items.emplace_back().wall.id = "straight";
  auto arcs = take_arcs(items, {});
  ASSERT_EQ(items.size(), 1U);
  ASSERT_EQ(arcs.size(), 1U);
  const std::vector<WallLine> refined = refine_arc(arcs.at("a0001"), {}, 0.06);
  EXPECT_NEAR(refined[3].a.norm(), 2.02, 1e-9);
  EXPECT_NEAR(refined[0].a.norm(), 2, 0.004);
}

}  // namespace
}  // namespace roomcut::refine_lines
