// SPDX-License-Identifier: GPL-3.0-or-later
// The subdivision against an arrangement in exact numbers: lines that meet in one point, run over each other,
// end on each other or in a corner do so exactly there, and to within rounding here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/cells/cell_complex.h"
#include "common/plan/segment_inserter.h"
#include "common/random/counter_random.h"
#include "tests/unit/plan/exact_plan.h"

namespace roomcut {
namespace {

using test::Ends;
using test::exact_plan;
using test::PlanCounts;

const Vec2 kHigh(20, 15);

/// Draws lines with whole numbers and eighths of them: what lies on each other does so in doubles, too.
class Lines {
 public:
  /// Corners on a grid of `step` metres, lines of at least `least_m`.
  Lines(std::uint64_t seed, int step, double least_m) : seed_(seed), step_(step), least_m_(least_m) {}

  std::vector<Ends> draw(int count) {
    while (static_cast<int>(lines_.size()) < count) {
      const Ends ends = one();
      if ((ends[1] - ends[0]).norm() >= least_m_ && inside(ends[0]) && inside(ends[1]))
        lines_.push_back(ends);
    }
    return lines_;
  }

 private:
  double unit() { return random_unit(seed_, 3, counter_++); }
  int below(int n) { return static_cast<int>(n * unit()); }
  Vec2 on_grid() { return {step_ * below(20 / step_ + 1), step_ * below(15 / step_ + 1)}; }
  static bool inside(const Vec2& p) {
    return p.x() >= 0 && p.y() >= 0 && p.x() <= kHigh.x() && p.y() <= kHigh.y();
  }
  const Ends& earlier() { return lines_[static_cast<std::size_t>(below(static_cast<int>(lines_.size())))]; }
  static Vec2 along(const Ends& line, int eighths) { return line[0] + eighths / 8.0 * (line[1] - line[0]); }

  Ends one() {
    const int kind = lines_.empty() ? 0 : below(8);
    switch (kind) {
      case 0:  // level or upright
        return below(2) == 0 ? level() : upright();
      case 1:  // over an earlier one
        return {along(earlier(), below(5)), along(earlier(), 4 + below(5))};
      case 2: {  // in a row with an earlier one
        const Ends& line = earlier();
        return {along(line, below(6) - 2), along(line, 5 + below(6))};
      }
      case 3:  // from a point of an earlier one
        return {along(earlier(), below(9)), on_grid()};
      case 4: {  // through one common point
        const Vec2 arm = on_grid() - Vec2(10, 10);
        return {Vec2(10, 10) - 0.5 * arm, Vec2(10, 10) + arm};
      }
      case 5:  // from a corner
        return {Vec2(below(2) * kHigh.x(), below(2) * kHigh.y()), on_grid()};
      case 6: {  // nearly parallel: turned by 1e-4 … 1e-2 rad
        Ends line = earlier();
        line[1] += Vec2(0, step_ == 1 ? std::ldexp(1 + below(15), -6 - below(4)) : step_);
        return line;
      }
      default:
        return {on_grid(), on_grid()};
    }
  }
  Ends level() {
    const Vec2 p = on_grid();
    return {p, {step_ * below(20 / step_ + 1), p.y()}};
  }
  Ends upright() {
    const Vec2 p = on_grid();
    return {p, {p.x(), step_ * below(15 / step_ + 1)}};
  }

  std::uint64_t seed_, counter_ = 0;
  int step_;
  double least_m_;
  std::vector<Ends> lines_;
};

PlanCounts subdivision_of(const std::vector<Ends>& lines) {
  Subdivision plan({0, 0}, kHigh);
  SegmentInserter inserter(plan);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line2 line = line_through(lines[i][0], lines[i][1]);
    const auto [t0, t1] = std::minmax({line.along(lines[i][0]), line.along(lines[i][1])});
    inserter.insert({line, t0, t1}, static_cast<std::int32_t>(i));
  }
  PlanCounts counts{plan.vertices.size(), plan.half_edges.size() / 2, plan.face_start.size(), {}};
  for (const std::int32_t start : plan.face_start) {
    double twice = 0;
    std::int32_t h = start;
    do {
      const Vec2& p = plan.from(h);
      const Vec2& q = plan.vertices[static_cast<std::size_t>(plan.target(h))];
      twice += p.x() * q.y() - p.y() * q.x();
      h = plan.half_edges[static_cast<std::size_t>(h)].next;
    } while (h != start);
    counts.areas.push_back(0.5 * twice);
  }
  std::sort(counts.areas.begin(), counts.areas.end());
  return counts;
}

void expect_equal(const PlanCounts& ours, const PlanCounts& exact, double area_m2, std::uint64_t seed) {
  ASSERT_EQ(ours.vertices, exact.vertices) << "seed " << seed;
  ASSERT_EQ(ours.edges, exact.edges) << "seed " << seed;
  ASSERT_EQ(ours.faces, exact.faces) << "seed " << seed;
  EXPECT_EQ(ours.vertices + ours.faces, ours.edges + 1) << "Euler's formula, seed " << seed;
  for (std::size_t i = 0; i < ours.areas.size(); ++i) {
    ASSERT_NEAR(ours.areas[i], exact.areas[i], area_m2) << "seed " << seed;
  }
  EXPECT_NEAR(std::accumulate(ours.areas.begin(), ours.areas.end(), 0.0), kHigh.x() * kHigh.y(), 1e-9);
}

TEST(SegmentInserter, CutsAsTheArrangementInExactNumbersDoes) {
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const std::vector<Ends> lines = Lines(seed, 1, 0.5).draw(4 + static_cast<int>(seed % 12));
    const PlanCounts exact = exact_plan(kHigh, lines);
    if (exact.margin < 3 * kPlanSnap_m) continue;  // something touches here that does not there
    ++compared;
    expect_equal(subdivision_of(lines), exact, 1e-9, seed);
  }
  EXPECT_GT(compared, 200);
}

TEST(SegmentInserter, WhatRoundingTookApartIsJoinedAgain) {
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    // Long lines: what rounding turns them by moves their far ends by less than kPlanSnap_m.
    std::vector<Ends> lines = Lines(seed, 5, 7).draw(4 + static_cast<int>(seed % 12));
    const PlanCounts exact = exact_plan(kHigh, lines);
    if (exact.margin < 100 * kPlanSnap_m) continue;
    ++compared;
    std::uint64_t counter = 0;
    for (Ends& ends : lines) {
      for (Vec2& p : ends) {
        p += 2e-7 * Vec2(random_unit(seed, 4, counter) - 0.5, random_unit(seed, 5, counter) - 0.5);
        ++counter;
      }
    }
    expect_equal(subdivision_of(lines), exact, 1e-4, seed);
  }
  EXPECT_GT(compared, 200);
}

}  // namespace
}  // namespace roomcut
