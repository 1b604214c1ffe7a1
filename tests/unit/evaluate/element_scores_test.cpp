// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/element_scores.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/mesh/shapes.h"

namespace roomcut::evaluate {
namespace {

using test::append;
using test::box;

const TriangleMesh kHall = box({0, 0, 0}, {6, 4, 3});
const TruthRoom kRoom{"hall", {{0, 0}, {6, 0}, {6, 4}, {0, 4}}, 0, 3, -1, true};

/// The hall without what stands over a rectangle from floor to ceiling, but for a slit.
TriangleMesh with_pillar(TriangleMesh mesh, const Vec2& lo, const Vec2& hi) {
  TriangleMesh pillar = box({lo.x(), lo.y(), 0.001}, {hi.x(), hi.y(), 2.999});
  flip_orientation(pillar);
  append(mesh, pillar);
  return mesh;
}

/// The hall with a ceiling that rises along y.
TriangleMesh under_roof(double degrees) {
  TriangleMesh mesh = kHall;
  for (Vec3& p : mesh.vertices) {
    if (p.z() > 1) p.z() += p.y() * std::tan(degrees * std::numbers::pi / 180);
  }
  return mesh;
}

SlopeScores slopes(const TriangleMesh& truth, const TriangleMesh& model) {
  const MeasuredSurface a(truth), b(model);
  return score_slopes(measure(truth, a, b, 0.05, 1), a, b);
}

TEST(ElementScores, TheAngleOfASlopeIsThatBetweenTruthAndModel) {
  const SlopeScores same = slopes(under_roof(30), under_roof(30));
  EXPECT_NEAR(same.area_m2, 24 / std::cos(30 * std::numbers::pi / 180), 1e-9);
  EXPECT_NEAR(*same.angle_p95_deg, 0, 1e-5);
  EXPECT_DOUBLE_EQ(*same.matched, 1);
  const SlopeScores off = slopes(under_roof(30), under_roof(30.5));
  EXPECT_NEAR(*off.angle_median_deg, 0.5, 1e-6);
  EXPECT_LT(*off.matched, 0.75);  // 4 cm off at the far side
  EXPECT_GT(*off.matched, 0.4);
  EXPECT_NEAR(*slopes(under_roof(12), kHall).angle_median_deg, 12, 1e-6);
  EXPECT_FALSE(slopes(kHall, kHall).angle_median_deg);  // level is no slope
}

TEST(ElementScores, ASlopeAtTheBorderOfTheClassesIsMet) {
  EXPECT_GT(*slopes(under_roof(24.9), under_roof(25.1)).matched, 0.95);
}

TEST(ElementScores, AColumnIsFoundWhenMoreThanHalfOfItIsSolid) {
  const std::vector<DescribedColumn> columns{{{{2, 2}, {2.4, 2}, {2.4, 2.4}, {2, 2.4}}, 0, 3, 0.4}};
  const TriangleMesh truth = with_pillar(kHall, {2, 2}, {2.4, 2.4});
  const Columns in_truth(truth);
  const auto score = [&](const TriangleMesh& model) {
    return score_columns(columns, {kRoom}, in_truth, Columns(model));
  };
  EXPECT_EQ(score(truth).found(), 1U);
  EXPECT_NEAR(score(truth).columns[0].solid, 1, 0.01);
  EXPECT_NEAR(score(truth).floor_m2, 24 - 0.16, 0.3);
  EXPECT_EQ(score(kHall).found(), 0U);
  const TriangleMesh thin = with_pillar(kHall, {2.0, 2.0}, {2.15, 2.4});
  EXPECT_EQ(score(thin).found(), 0U);
  EXPECT_NEAR(score(thin).columns[0].solid, 0.375, 0.05);
  EXPECT_EQ(score(thin).false_pillars, 0U);
}

TEST(ElementScores, AFalsePillarStandsFreeAndIsSmall) {
  const Columns truth(kHall);
  const auto pillars = [&](const Vec2& lo, const Vec2& hi) {
    const TriangleMesh model = with_pillar(kHall, lo, hi);
    return score_columns({}, {kRoom}, truth, Columns(model)).false_pillars;
  };
  EXPECT_EQ(pillars({2, 2}, {2.5, 2.5}), 1U);
  EXPECT_EQ(pillars({0.001, 2}, {0.5, 2.5}), 0U);  // a part of the wall
  EXPECT_EQ(pillars({2, 2}, {3.5, 2.9}), 0U);      // no pillar any more
}

TEST(ElementScores, ANicheIsMetWhereFacesOfTheModelLieWithinTwoCentimetres) {
  // The last 20 cm of the hall as its niche: 12 m2 at the back, 2.8 m2 beside, below and above.
  const std::vector<DescribedNiche> niches{{{{5.8, 0}, {6, 0}, {6, 4}, {5.8, 4}}, 0, 3, 4, 0.2, false}};
  const MeasuredSurface truth(kHall);
  const auto score = [&](const TriangleMesh& model) {
    const MeasuredSurface to(model);
    return score_niches(niches, measure(kHall, truth, to, 0.05, 1), truth, to);
  };
  EXPECT_NEAR(score(kHall).area_m2(), 14.8, 0.1);
  EXPECT_NEAR(score(kHall).near_m2(), score(kHall).area_m2(), 1e-9);
  EXPECT_NEAR(score(box({0, 0, 0}, {5.8, 4, 3})).near_m2(), 0.28, 0.1);
  EXPECT_NEAR(score(box({0, 0, 0}, {5.985, 4, 3})).near_m2(), 14.8, 0.1);
}

TEST(ElementScores, HeightsAreOffByTheMedianOfTheRoom) {
  const Columns truth(kHall);
  const TriangleMesh higher = box({0, 0, 0.004}, {6, 4, 2.99});
  const RoomHeights off = score_heights(kRoom, truth, Columns(higher));
  EXPECT_NEAR(*off.floor_off_m, 0.004, 1e-12);
  EXPECT_NEAR(*off.ceiling_off_m, -0.01, 1e-12);
  const TriangleMesh elsewhere = box({0, 0, 4}, {6, 4, 7});
  EXPECT_FALSE(score_heights(kRoom, truth, Columns(elsewhere)).floor_off_m);
  const TriangleMesh roof = under_roof(30);
  TruthRoom room = kRoom;
  room.ceiling = 6;
  EXPECT_NEAR(*score_heights(room, Columns(roof), Columns(roof)).ceiling_off_m, 0, 1e-12);
}

}  // namespace
}  // namespace roomcut::evaluate
