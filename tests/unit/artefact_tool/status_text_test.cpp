// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "common/artefact_tool/status.h"

namespace roomcut {
namespace {

using Words = std::vector<std::string>;

/// lines -> cells -> labels -> refined (also from lines), labels -> model
const char* const kPipeline =
    "detect detect : lines : params/detect.json\n"
    "partition partition : cells : params/partition.json lines\n"
    "cut cut : labels margins : params/cut.json cells\n"
    "refine refine : refined : params/refine.json lines labels\n"
    "extract extract : model : params/extract.json labels\n";

TEST(Status, ReadsThePipelineAndWhatMakeSays) {
  const auto pipeline = parse_pipeline(kPipeline);
  ASSERT_EQ(pipeline.size(), 5U);
  EXPECT_EQ(pipeline[2].outputs, (Words{"labels", "margins"}));
  EXPECT_EQ(pipeline[3].inputs, (Words{"params/refine.json", "lines", "labels"}));
  const auto stale = parse_stale("cut params/cut.json missing:labels\nextract \n");
  ASSERT_EQ(stale.size(), 2U);
  EXPECT_EQ(stale[0].changed, Words{"params/cut.json"});
  EXPECT_EQ(stale[0].missing, Words{"labels"});
  EXPECT_TRUE(stale[1].changed.empty());
}

TEST(Status, AStageWaitsForTheNearestStaleStagesBeforeIt) {
  const auto pipeline = parse_pipeline(kPipeline);
  const auto waits = waits_for(pipeline, parse_stale("detect x\ncut x\n"));
  EXPECT_TRUE(waits[0].empty());
  EXPECT_EQ(waits[1], Words{"detect"});
  EXPECT_EQ(waits[3], (Words{"detect", "cut"}));
  EXPECT_EQ(waits[4], Words{"cut"});
  EXPECT_TRUE(waits_for(pipeline, {})[4].empty());
}

TEST(Status, NamesEveryParameterThatDiffers) {
  EXPECT_EQ(
      describe_parameters(R"({"a":1,"mu_m":0.3,"old":2})", R"({"a":1,"mu_m":0.5,"new":"auto"})"),
      (Words{"parameter mu_m changed 0.3 -> 0.5", "parameter new is new (auto)", "parameter old is gone"}));
  EXPECT_TRUE(describe_parameters(R"({"a":1})", R"({"a":1})").empty());
  EXPECT_TRUE(describe_parameters("", "{}").empty());
}

}  // namespace
}  // namespace roomcut
