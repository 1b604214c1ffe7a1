// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/surface_scores.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "tests/unit/mesh/shapes.h"

namespace roomcut::evaluate {
namespace {

using test::box;

SurfaceDistances from_to(const TriangleMesh& from, const TriangleMesh& to) {
  const MeasuredSurface a(from), b(to);
  return measure(from, a, b, 0.1, 1);
}

const TriangleMesh kTruth = box({0, 0, 0}, {6, 4, 3});

TEST(SurfaceScores, WallsHorizontalsAndSlopesAreToldApart) {
  EXPECT_EQ(slope_class({1, 0, 0}), SlopeClass::kWall);
  EXPECT_EQ(slope_class({0.99, 0, 0.1}), SlopeClass::kWall);
  EXPECT_EQ(slope_class({0, 0, -1}), SlopeClass::kHorizontal);
  EXPECT_EQ(slope_class({0, 0.7, 0.7}), SlopeClass::kSloped);
}

TEST(SurfaceScores, AModelShiftedAlongXMovesTwoWallsOnly) {
  const TriangleMesh model = box({0.01, 0, 0}, {6.01, 4, 3});
  const SurfaceDistances truth = from_to(kTruth, model);
  EXPECT_NEAR(truth.deviation.max, 0.01, 1e-9);
  // Two of the six sides, 24 of 108 m2, are 1 cm off; on the others only a rim of 1 cm is.
  EXPECT_NEAR(truth.deviation.mean, 0.01 * 24 / 108, 1e-5);
  EXPECT_NEAR(truth.deviation.rms, 0.01 * std::sqrt(24.0 / 108), 1e-5);
  EXPECT_NEAR(truth.deviation.p95, 0.01, 1e-9);
  const SurfaceDistances reverse = from_to(model, kTruth);
  const IsprsScore at_5mm = isprs_score(truth, reverse, SlopeClass::kWall, 0.005);
  EXPECT_NEAR(*at_5mm.completeness, 36.0 / 60, 2e-3);
  EXPECT_NEAR(*at_5mm.correctness, 36.0 / 60, 2e-3);
  EXPECT_NEAR(*at_5mm.accuracy_m, 0, 1e-9);
  const IsprsScore at_1cm = isprs_score(truth, reverse, SlopeClass::kWall, 0.01);
  EXPECT_DOUBLE_EQ(*at_1cm.completeness, 1);
  EXPECT_DOUBLE_EQ(*at_1cm.correctness, 1);
  EXPECT_NEAR(*matched_share(truth, SlopeClass::kWall), 1, 1e-12);
}

TEST(SurfaceScores, AWallThatIsOffByMoreThanTwoCentimetresDoesNotMatch) {
  const SurfaceDistances truth = from_to(kTruth, box({0.021, 0, 0}, {6, 4, 3}));
  EXPECT_NEAR(*matched_share(truth, SlopeClass::kWall), 48.0 / 60, 2e-3);
}

TEST(SurfaceScores, AFloorThatIsOffByMoreThanFiveMillimetresIsFollowedCloselyButNotFinely) {
  const SurfaceDistances near = from_to(kTruth, box({0, 0, 0.0049}, {6, 4, 3}));
  EXPECT_NEAR(*matched_share(near, SlopeClass::kHorizontal, Match::kFine), 1, 1e-12);
  const SurfaceDistances off = from_to(kTruth, box({0, 0, 0.0051}, {6, 4, 3}));
  EXPECT_NEAR(*matched_share(off, SlopeClass::kHorizontal, Match::kFine), 0.5, 5e-3);
  EXPECT_NEAR(*matched_share(off, SlopeClass::kHorizontal), 1, 1e-12);
}

TEST(SurfaceScores, AWallThatIsOffByTwoToFourCentimetresIsFollowedLoosely) {
  const SurfaceDistances off = from_to(kTruth, box({0.039, 0, 0}, {6, 4, 3}));
  EXPECT_NEAR(*matched_share(off, SlopeClass::kWall), 48.0 / 60, 5e-3);
  EXPECT_NEAR(*matched_share(off, SlopeClass::kWall, Match::kLoose), 1, 5e-3);
  const SurfaceDistances farther = from_to(kTruth, box({0.041, 0, 0}, {6, 4, 3}));
  EXPECT_NEAR(*matched_share(farther, SlopeClass::kWall, Match::kLoose), 48.0 / 60, 5e-3);
}

TEST(SurfaceScores, ACeilingThatIsOffByMoreThanTwoCentimetresDoesNotMatchButItsFloorDoes) {
  EXPECT_NEAR(*matched_share(from_to(kTruth, kTruth), SlopeClass::kHorizontal), 1, 1e-12);
  const SurfaceDistances truth = from_to(kTruth, box({0, 0, 0}, {6, 4, 3.021}));
  EXPECT_NEAR(*matched_share(truth, SlopeClass::kHorizontal), 0.5, 2e-3);
}

TEST(SurfaceScores, AWallTurnedByMoreThanOneDegreeDoesNotMatch) {
  TriangleMesh model = kTruth;
  for (Vec3& p : model.vertices) {
    if (p.x() == 6 && p.y() == 4)
      p.x() += 4 * std::tan(1.2 * std::numbers::pi / 180);  // the wall at x = 6 turns about y = 0
  }
  const SurfaceDistances truth = from_to(kTruth, model);
  EXPECT_NEAR(*matched_share(truth, SlopeClass::kWall), 48.0 / 60, 5e-3);
  EXPECT_LT(*isprs_score(truth, from_to(model, kTruth), SlopeClass::kWall, 0.02).completeness, 1);
}

TEST(SurfaceScores, AMissingStoreyLowersCompletenessAndNotCorrectness) {
  TriangleMesh truth = kTruth;
  test::append(truth, box({0, 0, 3.3}, {6, 4, 6.3}));
  const SurfaceDistances of_truth = from_to(truth, kTruth);
  const SurfaceDistances of_model = from_to(kTruth, truth);
  const IsprsScore walls = isprs_score(of_truth, of_model, SlopeClass::kWall, 0.1);
  EXPECT_NEAR(*walls.completeness, 0.5, 1e-2);
  EXPECT_DOUBLE_EQ(*walls.correctness, 1);
  const IsprsScore horizontals = isprs_score(of_truth, of_model, SlopeClass::kHorizontal, 0.1);
  EXPECT_NEAR(*horizontals.completeness, 0.5, 1e-9);
  EXPECT_NEAR(of_truth.deviation.max, 3.3, 1e-9);
}

TEST(SurfaceScores, OneThreadGivesTheSameNumbersAsMany) {
  const TriangleMesh model = box({0.013, 0.02, -0.01}, {6.1, 3.9, 3.02});
  const SurfaceDistances many = from_to(kTruth, model);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const SurfaceDistances single = from_to(kTruth, model);
  EXPECT_EQ(many.distance, single.distance);
  EXPECT_EQ(many.class_distance, single.class_distance);
  EXPECT_EQ(many.match, single.match);
}

}  // namespace
}  // namespace roomcut::evaluate
