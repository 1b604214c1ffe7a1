// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/evaluate.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "common/errors/error.h"
#include "tests/unit/mesh/shapes.h"

namespace roomcut::evaluate {
namespace {

using test::append;
using test::box;

const EvaluateParams kCoarse = [] {  // quick
  EvaluateParams params;
  params.sample_spacing_m = 0.05;
  params.column_spacing_m = 0.02;
  return params;
}();

TriangleMesh two_rooms() {
  TriangleMesh mesh = box({-4, -2, 0}, {-0.1, 2, 2.7});
  append(mesh, box({0, -2, 0.15}, {5, 2.5, 3}));
  return mesh;
}

TEST(Evaluate, AMeshAgainstItselfIsPerfect) {
  const Scores scores = evaluate(two_rooms(), two_rooms(), {}, kCoarse);
  EXPECT_LT(scores.model_to_truth.max, 1e-9);
  EXPECT_LT(scores.truth_to_model.max, 1e-9);
  EXPECT_DOUBLE_EQ(scores.volume->iou(), 1);
  EXPECT_DOUBLE_EQ(*scores.walls_matched, 1);
  for (const Scores::Isprs& at : scores.isprs) {
    EXPECT_DOUBLE_EQ(*at.walls.completeness, 1);
    EXPECT_DOUBLE_EQ(*at.horizontals.correctness, 1);
  }
  EXPECT_EQ(scores.found(), 2U);
  EXPECT_TRUE(scores.model_check.valid());
}

TEST(Evaluate, AShiftOfOneCentimetreGivesTheKnownOverlap) {
  const TriangleMesh model = prepared(two_rooms(), {Vec3(-0.01, 0, 0)});
  const Scores scores = evaluate(model, two_rooms(), {}, kCoarse);
  EXPECT_NEAR(scores.model_to_truth.max, 0.01, 1e-9);
  EXPECT_NEAR(scores.truth_to_model.max, 0.01, 1e-9);
  const double volume = 3.9 * 4 * 2.7 + 5 * 4.5 * 2.85;
  const double lost = 0.01 * (4 * 2.7 + 4.5 * 2.85);
  EXPECT_NEAR(scores.volume->truth_m3, volume, 2e-3 * volume);
  EXPECT_NEAR(scores.volume->iou(), (volume - lost) / (volume + lost), 5e-4);
}

TEST(Evaluate, TheOriginDoesNotMatterMillionsOfMetresAway) {
  const Vec3 far(500000, 6000000, 300);
  const TriangleMesh shifted = prepared(two_rooms(), {-far});
  const Scores scores = evaluate(prepared(shifted, {far}), two_rooms(), {}, kCoarse);
  EXPECT_LT(scores.model_to_truth.max, 1e-8);
  EXPECT_GT(scores.volume->iou(), 1 - 1e-6);
}

TEST(Evaluate, OrientationOfTheFilesDoesNotMatter) {
  TriangleMesh turned = two_rooms();
  flip_orientation(turned);
  const Scores scores = evaluate(prepared(turned, {}), two_rooms(), {}, kCoarse);
  EXPECT_DOUBLE_EQ(scores.volume->iou(), 1);
  EXPECT_DOUBLE_EQ(*scores.walls_matched, 1);
}

TEST(Evaluate, AnOpenModelIsScoredWithoutVolumes) {
  TriangleMesh model = two_rooms();
  model.triangles.pop_back();
  const Scores scores = evaluate(model, two_rooms(), {}, kCoarse);
  EXPECT_FALSE(scores.volume);
  EXPECT_FALSE(scores.model_check.closed());
  EXPECT_GT(scores.truth_to_model.max, 0.1);
}

TEST(Evaluate, AnOpenTruthIsRefused) {
  TriangleMesh truth = two_rooms();
  truth.triangles.pop_back();
  try {
    evaluate(two_rooms(), truth, {}, kCoarse);
    FAIL();
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems().front().code.id, "M03");
  }
}

TEST(Evaluate, OneThreadGivesTheSameNumbersAsMany) {
  const TriangleMesh model = box({-4, -2, 0.01}, {5, 2.2, 2.9});
  const Scores many = evaluate(model, two_rooms(), {}, kCoarse);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Scores single = evaluate(model, two_rooms(), {}, kCoarse);
  EXPECT_EQ(many.volume->common_m3, single.volume->common_m3);
  EXPECT_EQ(many.truth_to_model.rms, single.truth_to_model.rms);
  EXPECT_EQ(many.thin.wall_kept_m2, single.thin.wall_kept_m2);
}

}  // namespace
}  // namespace roomcut::evaluate
