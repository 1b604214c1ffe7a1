// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/plan/plan_complex.h"

#include <gtest/gtest.h>

#include <numbers>

#include "common/plan/segment_inserter.h"
#include "common/random/counter_random.h"

namespace roomcut {
namespace {

/// Cuts segments of 1 … 5 m and any direction: through any place of the rectangle, or, where the complex has
/// faces already, through the middle of any of them.
void cut_at_random(std::uint64_t seed, int count, CellComplex& complex, Subdivision& plan) {
  SegmentInserter inserter(plan);
  std::uint64_t counter = 0;
  const auto unit = [&] { return random_unit(seed, 1, counter++); };
  for (int n = 0; n < count; ++n) {
    const auto within = static_cast<std::int32_t>(static_cast<double>(complex.faces()) * unit());
    const Vec2 anywhere(20 * unit(), 15 * unit());
    const Vec2 middle = complex.faces() > 0 ? complex.centroid(static_cast<std::size_t>(within)) : anywhere;
    const double angle = std::numbers::pi * unit();
    const Line2 line{angle, Line2{angle, 0}.distance(middle)};
    const double half = 0.5 + 2 * unit();
    const PlanSegment segment{line, line.along(middle) - half, line.along(middle) + half};
    const auto index = static_cast<std::int32_t>(complex.lines.size());
    complex.lines.push_back({"w" + std::to_string(index), line, segment.t0, segment.t1, {}});
    inserter.insert(segment, index, within);
  }
}

CellComplex random_complex(std::uint64_t seed) {
  CellComplex complex;
  complex.levels = {0, 2.5};
  Subdivision plan({0, 0}, {20, 15});
  cut_at_random(seed, 12, complex, plan);
  set_plan(plan, plan.faces_in_tree_order(), complex);
  return complex;
}

TEST(PlanComplex, ThePlanOfAComplexGivesItBackAsItWas) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const CellComplex complex = random_complex(seed);
    ASSERT_GT(complex.faces(), 12U);
    const Subdivision plan = plan_of(complex);
    CellComplex again = complex;
    set_plan(plan, plan.faces_in_tree_order(), again);
    EXPECT_EQ(again.vertices, complex.vertices);
    EXPECT_EQ(again.face_offset, complex.face_offset);
    EXPECT_EQ(again.face_vertex, complex.face_vertex);
    EXPECT_EQ(again.face_edge, complex.face_edge);
    EXPECT_EQ(find_violation(again), "");
  }
}

TEST(PlanComplex, APlanThatIsCutFurtherStaysValidAndEveryFaceKnowsWhatItWasPartOf) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const CellComplex before = random_complex(seed);
    CellComplex after = before;
    Subdivision plan = plan_of(before);
    cut_at_random(seed + 100, 8, after, plan);
    const std::vector<std::int32_t> faces = plan.faces_in_tree_order();
    set_plan(plan, faces, after);
    ASSERT_EQ(find_violation(after), "") << "seed " << seed;
    EXPECT_GE(after.faces(), before.faces() + 8);
    std::vector<double> area(before.faces(), 0);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      area[plan.original[faces[i]]] += after.area(i);
    }
    for (std::size_t face = 0; face < before.faces(); ++face) {
      EXPECT_NEAR(area[face], before.area(face), 1e-9) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace roomcut
