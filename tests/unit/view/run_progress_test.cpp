// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/run_progress.h"

#include <gtest/gtest.h>

namespace roomcut::view {
namespace {

TEST(RunProgress, FollowsTheStagesAndKeepsTheOtherLines) {
  RunProgress run;
  run.start();
  run.add_line("@stage 7 15 raycast");
  run.add_line("raycast: rays = 64 (a cell)");
  EXPECT_TRUE(run.running);
  EXPECT_EQ(run.stage, "raycast");
  EXPECT_EQ(run.done, 6);
  EXPECT_EQ(run.of, 15);
  ASSERT_EQ(run.log.size(), 1U);
  run.finish(0);
  EXPECT_FALSE(run.running);
  EXPECT_EQ(run.stage, "");
  EXPECT_EQ(run.done, 15);
  EXPECT_EQ(run.exit_code, 0);
}

TEST(RunProgress, AFailedRunKeepsItsStageAndTheFirstErrorWithItsHint) {
  RunProgress run;
  run.start();
  run.add_line("@stage 4 15 accept_lines");
  run.add_line("error[L07] edits/wall_lines.geojson: features[1]: both ends are equal");
  run.add_line("hint: move an end");
  run.add_line("error[L05] another");
  run.add_line("hint: another one");
  run.finish(2);
  EXPECT_EQ(run.stage, "accept_lines");
  EXPECT_EQ(run.error,
            "error[L07] edits/wall_lines.geojson: features[1]: both ends are equal\nhint: move an end");
  run.start();
  EXPECT_EQ(run.error, "");
  run.finish(137);
  EXPECT_EQ(run.error, "the run ended with code 137");
}

TEST(RunProgress, KeepsTheLastLinesOnly) {
  RunProgress run;
  run.start();
  for (int i = 0; i < 1000; ++i) {
    run.add_line(std::to_string(i));
  }
  EXPECT_EQ(run.log.size(), RunProgress::kLogLines);
  EXPECT_EQ(run.log.back(), "999");
}

}  // namespace
}  // namespace roomcut::view
