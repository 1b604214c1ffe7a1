// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/compare/comparison_words.h"

#include <gtest/gtest.h>

#include "stages/tools/compare/storey_plans.h"
#include "tests/unit/compare/square_run.h"

namespace roomcut::compare {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(ComparisonText, says_what_differs_and_nothing_else) {
  const RunFacts a = square_run("old", 6), b = square_run("new", 6.02);
  const std::string text = comparison_text(a, b, compare_runs(a, b), std::nullopt);
  EXPECT_TRUE(has(text, "A old\nB new\nThe same scan.\nParameters\n  no difference\n")) << text;
  EXPECT_TRUE(has(text, "area [m2]  24.00  24.08  +0.08")) << text;
  EXPECT_FALSE(has(text, "  rooms  ")) << text;
  EXPECT_TRUE(has(text, "w0002  w0002  moved                 20.0")) << text;
  EXPECT_TRUE(has(text, "1 the same, 3 moved")) << text;
  EXPECT_TRUE(has(text, "24.00        24.08")) << text;
  EXPECT_TRUE(has(text, "One of the two has no model.")) << text;
}

TEST(ComparisonText, distances_are_in_millimetres) {
  const RunFacts a = square_run("old", 6);
  ModelDistance distance;
  distance.b_to_a = {0.0012, 0.002, 0.003, 0.02};
  distance.a_m3 = 72;
  distance.b_m3 = 73;
  distance.common_m3 = 71.5;
  const std::string text = comparison_text(a, a, compare_runs(a, a), distance);
  EXPECT_TRUE(has(text, "1.2       2.0              3.0          20.0")) << text;
  EXPECT_TRUE(has(text, "Empty in A only: 0.50 m3, in B only: 1.50 m3, in both: 71.50 m3.")) << text;
}

TEST(ComparisonHtml, is_one_page_that_loads_nothing) {
  RunFacts a = square_run("<old>", 6);
  const std::string html = comparison_html(a, a, compare_runs(a, a), std::nullopt, "picture");
  EXPECT_TRUE(has(html, "default-src 'none'"));
  EXPECT_FALSE(has(html, "<script"));
  EXPECT_FALSE(has(html, "<old>"));
  EXPECT_TRUE(has(html, "&lt;old&gt;"));
  EXPECT_TRUE(has(html, "src=\"data:image/png;base64,cGljdHVyZQ==\""));
  EXPECT_TRUE(has(html, "Storey 0, floor at 0.00 m"));
}

TEST(StoreyPlans, show_what_only_one_run_calls_empty) {
  const RunFacts a = square_run("a", 6), b = square_run("b", 7);
  const auto plans = draw_storeys(a, b, compare_runs(a, b));
  ASSERT_EQ(plans.size(), 1U);
  EXPECT_FALSE(plans[0].a.empty());
  EXPECT_FALSE(plans[0].b.empty());
  EXPECT_TRUE(has(plans[0].difference, "mask=\"url(#only-a-0)\"") &&
              has(plans[0].difference, "mask=\"url(#only-b-0)\""));
  // All three show the same part of the plan, so that they can be laid over each other.
  const auto head = [](const std::string& svg) { return svg.substr(0, svg.find('>')); };
  EXPECT_EQ(head(plans[0].a), head(plans[0].b));
  EXPECT_EQ(head(plans[0].a), head(plans[0].difference));
}

TEST(StoreyPlans, a_storey_that_only_one_run_has_is_drawn_alone) {
  const RunFacts a = square_run("a", 6);
  RunFacts b = a;
  b.storeys.clear();
  const auto plans = draw_storeys(a, b, compare_runs(a, b));
  ASSERT_EQ(plans.size(), 1U);
  EXPECT_TRUE(plans[0].b.empty());
  EXPECT_FALSE(plans[0].a.empty());
}

TEST(StoreyPlans, unknown_cells_have_a_colour_of_their_own) {
  RunFacts a = square_run("a", 5);
  const RunFacts b = a;
  a.plan->labels.label[5] = Label::kUnknown;
  const std::vector<StoreyPlans> plans = draw_storeys(a, b, compare_runs(a, b));
  ASSERT_EQ(plans.size(), 1U);
  const std::string yellow = "#f0e442";
  EXPECT_TRUE(has(plans[0].a, yellow)) << plans[0].a;
  EXPECT_FALSE(has(plans[0].b, yellow));
}

}  // namespace
}  // namespace roomcut::compare
