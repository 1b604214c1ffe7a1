// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/arc_scores.h"

#include <gtest/gtest.h>

#include <numbers>

namespace roomcut::evaluate {
namespace {

constexpr double kPi = std::numbers::pi;

const DescribedArc kBay{{1, 2}, 2, 0.3, 1.5, 0, 2.7};
const DescribedArc kTower{{9, 2}, 3, 0, 2 * kPi, 0, 2.7};

TEST(ArcScores, ArcsCloseByAreFoundWithTheirErrors) {
  DescribedArc bay = kBay;
  bay.radius_m += 0.004;
  bay.centre.x() -= 0.004;
  bay.from -= 2 * kPi;  // any turn more or less is the same
  const ArcScores scores = score_arcs({kBay, kTower}, {kTower, bay});
  EXPECT_EQ(scores.found(), 2U);
  EXPECT_EQ(scores.false_arcs, 0U);
  EXPECT_NEAR(scores.arcs[0].radius_error_m, 0.004, 1e-12);
  EXPECT_NEAR(scores.arcs[0].centre_error_m, 0.004, 1e-12);
  EXPECT_EQ(scores.close(), 2U);
  EXPECT_NEAR(*scores.f1(), 1, 1e-12);
}

TEST(ArcScores, AnotherStoreysOrAWallsOtherFaceOrAPieceIsNotIt) {
  DescribedArc above = kBay, behind = kBay, piece = kBay;
  above.z0 = 3;
  above.z1 = 5.7;
  behind.radius_m += 0.2;
  piece.sweep = 0.5;
  for (const DescribedArc& arc : {above, behind, piece}) {
    const ArcScores scores = score_arcs({kBay}, {arc});
    EXPECT_EQ(scores.found(), 0U);
    EXPECT_EQ(scores.false_arcs, 1U);
    EXPECT_NEAR(*scores.f1(), 0, 1e-12);
  }
}

TEST(ArcScores, ASecondArcOnTheSameWallIsFalseAndAWrongRadiusIsNotClose) {
  DescribedArc wrong = kBay;
  wrong.radius_m += 0.02;
  const ArcScores scores = score_arcs({kBay}, {wrong, wrong});
  EXPECT_EQ(scores.found(), 1U);
  EXPECT_EQ(scores.close(), 0U);
  EXPECT_EQ(scores.false_arcs, 1U);
  EXPECT_NEAR(*scores.precision(), 0.5, 1e-12);
  EXPECT_NEAR(*scores.recall(), 1, 1e-12);
}

TEST(ArcScores, WhereNothingIsCurvedThereAreNoShares) {
  EXPECT_FALSE(score_arcs({}, {}).f1());
  EXPECT_EQ(*score_arcs({}, {kBay}).f1(), 0);
}

}  // namespace
}  // namespace roomcut::evaluate
