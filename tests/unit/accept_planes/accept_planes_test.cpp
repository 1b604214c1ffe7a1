// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/accept_planes/accept_planes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/slices/plane_steps.h"

namespace roomcut::accept_planes {
namespace {

SlopedPlane rising(double low, double high) {
  SlopedPlane plane;
  plane.gradient = {0.5, 0};
  plane.c = low;
  plane.outline = {{0, 0}, {2 * (high - low), 0}, {2 * (high - low), 3}, {0, 3}};
  plane.area_m2 = 20;
  return plane;
}

/// A floor and a cap, a plane between with its steps, and a step that stands for something else.
Slices slices() {
  Slices slices;
  slices.step_m = 0.3;
  slices.bbox_max = {10, 10, 6};
  slices.planes = {rising(2.5, 3.4)};
  slices.levels = {{0, 0, 0, 30, 30}, cap_level(6)};
  add_steps(slices.levels, slices.planes, {step_level(5)}, slices.step_m);
  return slices;
}

std::vector<double> steps_of(const AcceptedPlanes& planes) {
  std::vector<double> z;
  for (const Level& level : planes.levels) {
    if (level.step) z.push_back(level.z);
  }
  return z;
}

Acceptance accept(const std::optional<AcceptedPlanes>& edit) {
  return accept_planes(slices(), detected_planes(slices()), "digest", edit);
}

PlaneFeature added(const char* id, const SlopedPlane& plane) {
  PlaneFeature feature;
  feature.id = id;
  feature.plane = plane;
  feature.source = LineSource::kAdded;
  return feature;
}

TEST(AcceptPlanes, WithoutAnEditTheDetectionGoesOnWithSlicesLevels) {
  const Acceptance accepted = accept(std::nullopt);
  ASSERT_EQ(accepted.planes.planes.size(), 1U);
  EXPECT_EQ(accepted.planes.planes[0].id, "p0001");
  EXPECT_EQ(accepted.planes.base_sha256, "digest");
  ASSERT_EQ(accepted.planes.levels.size(), slices().levels.size());
  for (std::size_t i = 0; i < slices().levels.size(); ++i) {
    EXPECT_EQ(accepted.planes.levels[i].z, slices().levels[i].z);
  }
  EXPECT_EQ(steps_of(accepted.planes).size(), 4U);
}

TEST(AcceptPlanes, ADeletedPlaneTakesItsStepsWithItAndLeavesOthers) {
  AcceptedPlanes edit = detected_planes(slices());
  edit.planes.clear();
  const Acceptance accepted = accept(edit);
  EXPECT_EQ(accepted.deleted, 1);
  EXPECT_TRUE(accepted.steps_moved);
  EXPECT_EQ(steps_of(accepted.planes), std::vector<double>{5});
}

TEST(AcceptPlanes, AnAddedPlaneGetsItsSteps) {
  AcceptedPlanes edit = detected_planes(slices());
  edit.planes.push_back(added("e0001", rising(1.0, 1.6)));
  const Acceptance accepted = accept(edit);
  EXPECT_EQ(accepted.added, 1);
  EXPECT_EQ(accepted.kept, 1);
  const std::vector<double> steps = steps_of(accepted.planes);
  ASSERT_EQ(steps.size(), 6U);
  EXPECT_NEAR(steps[0], 1.15, 1e-9);
  EXPECT_NEAR(steps[1], 1.45, 1e-9);
}

TEST(AcceptPlanes, APlaneBeyondTheLastLevelGetsACapAboveIt) {
  AcceptedPlanes edit = detected_planes(slices());
  edit.planes.push_back(added("e0001", rising(5.5, 7)));
  edit.planes.push_back(added("e0002", rising(-1, 0.5)));
  const std::vector<Level> levels = accept(edit).planes.levels;
  EXPECT_TRUE(levels.back().cap);
  EXPECT_GE(levels.back().z, 7.1);
  EXPECT_TRUE(levels.front().cap);
  EXPECT_LE(levels.front().z, -1.1);
  EXPECT_TRUE(std::any_of(levels.begin(), levels.end(), [](const Level& l) { return l.z == 0 && !l.cap; }));
  EXPECT_TRUE(
      std::is_sorted(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.z < b.z; }));
}

TEST(AcceptPlanes, AnEditThatBeganFromAnotherDetectionKeepsItsBaseAndIsSaid) {
  AcceptedPlanes edit = detected_planes(slices());
  edit.base_sha256 = "another";
  EXPECT_TRUE(accept(edit).base_moved);
  EXPECT_EQ(accept(edit).planes.base_sha256, "another");
  edit.base_sha256 = "";
  EXPECT_FALSE(accept(edit).base_moved);
  EXPECT_EQ(accept(edit).planes.base_sha256, "digest");
}

}  // namespace
}  // namespace roomcut::accept_planes
