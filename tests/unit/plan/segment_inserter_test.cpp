// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/plan/segment_inserter.h"

#include <gtest/gtest.h>

#include <numbers>

namespace roomcut {
namespace {

constexpr double kHalfTurn = 0.5 * std::numbers::pi;

TEST(SegmentInserter, ALineThroughTheRectangleMakesTwoFaces) {
  Subdivision plan({0, 0}, {4, 3});
  SegmentInserter inserter(plan);
  EXPECT_EQ(inserter.insert({{0, 1}, 1, 2}, 0), 1);  // x = 1; a support in the middle cuts the whole face
  EXPECT_EQ(plan.vertices.size(), 6U);
}

TEST(SegmentInserter, OnlyTheFacesThatTheSegmentEntersAreSplit) {
  Subdivision plan({0, 0}, {4, 4});
  SegmentInserter inserter(plan);
  inserter.insert({{kHalfTurn, 2}, -4, 0}, 0);             // y = 2; its direction is -x
  EXPECT_EQ(inserter.insert({{0, 1}, 0.5, 1.0}, 1), 1);    // x = 1 below y = 2 only
  EXPECT_EQ(inserter.insert({{0, 2}, 0.5, 2.0}, 2), 1);    // ends on y = 2: does not enter the upper face
  EXPECT_EQ(inserter.insert({{0, 3}, 0.5, 2.001}, 3), 2);  // enters it
  EXPECT_EQ(plan.face_start.size(), 6U);
}

TEST(SegmentInserter, ARepeatedLineOrOneWithinTheSnappingDistanceCutsNothing) {
  Subdivision plan({0, 0}, {4, 3});
  SegmentInserter inserter(plan);
  EXPECT_EQ(inserter.insert({{0, 1}, 0, 3}, 0), 1);
  EXPECT_EQ(inserter.insert({{0, 1}, 0, 3}, 1), 0);
  EXPECT_EQ(inserter.insert({{0, 1 + 1e-9}, 0, 3}, 2), 0);
  EXPECT_EQ(inserter.insert({{0, 1 + 1e-6}, 0, 3}, 3), 0);
  EXPECT_EQ(inserter.insert({{0, 1 + 1e-4}, 0, 3}, 4), 1);
}

TEST(SegmentInserter, LinesThroughOnePointMeetInOneVertex) {
  Subdivision plan({-1, -1}, {1, 1});
  SegmentInserter inserter(plan);
  int faces = 1;
  for (int i = 0; i < 12; ++i) {
    const double theta = 0.01 + i * std::numbers::pi / 12;
    faces += inserter.insert({{theta, 1e-6 * (i % 3)}, -9, 9}, i);  // as if rounded to 6 decimals
  }
  EXPECT_EQ(faces, 24);
  EXPECT_EQ(plan.vertices.size(), 4U + 24U + 1U);
}

TEST(SegmentInserter, ALineOutsideTheRectangleOrBesideItsSegmentCutsNothing) {
  Subdivision plan({0, 0}, {4, 3});
  SegmentInserter inserter(plan);
  EXPECT_EQ(inserter.insert({{0, 9}, 0, 3}, 0), 0);
  EXPECT_EQ(inserter.insert({{0, 1}, 5, 8}, 0), 0);
}

}  // namespace
}  // namespace roomcut
