// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/pipeline/pipeline_table.h"

#include <gtest/gtest.h>

#include <set>

namespace roomcut {
namespace {

constexpr const char* kText =
    "# a comment | with | bars | in it\n"
    "\n"
    "first  | cut   | scan inputs/a.txt edit=edits/e.json | cells-out:cells=1_cut/cells.h5\n"
    "second | cut   | edit cells                          | cells-out:more=2_cut/cells.h5\r\n"
    "-      | judge | model:more                          | scores=scores.json";

TEST(PipelineTable, has_the_runs_in_order_and_each_program_once) {
  const PipelineTable table(kText);
  ASSERT_EQ(table.runs().size(), 2U);
  EXPECT_EQ(table.runs()[0].name, "first");
  EXPECT_EQ(table.runs()[1].program, "cut");
  EXPECT_EQ(table.programs(), (std::vector<std::string>{"cut", "judge"}));
}

TEST(PipelineTable, knows_where_artefacts_lie_and_what_options_mean) {
  const PipelineTable table(kText);
  EXPECT_EQ(table.path("cells"), "1_cut/cells.h5");
  EXPECT_EQ(table.path("edit"), "edits/e.json");
  EXPECT_EQ(table.default_path("cut", "cells-out"), "1_cut/cells.h5");
  EXPECT_EQ(table.default_path("judge", "model"), "2_cut/cells.h5");
  EXPECT_EQ(table.default_path("cut", "scan"), std::nullopt) << "the scan lies wherever the user has it";
  EXPECT_EQ(table.default_path("draw", "model"), std::nullopt);
  EXPECT_EQ(table.runs()[0].reads[0].path, "scan");
  EXPECT_EQ(table.runs()[0].reads[1].path, "inputs/a.txt");
}

TEST(PipelineTable, gives_a_later_run_of_a_program_its_own_files_as_options) {
  const PipelineTable table(kText);
  EXPECT_EQ(make_rule(table, table.runs()[0]),
            "$(eval $(call stage,first,cut,1_cut/cells.h5,scan inputs/a.txt edits/e.json,))\n");
  EXPECT_EQ(
      make_rule(table, table.runs()[1]),
      "$(eval $(call stage,second,cut,2_cut/cells.h5,edits/e.json 1_cut/cells.h5, --cells 1_cut/cells.h5 "
      "--cells-out 2_cut/cells.h5))\n");
}

TEST(PipelineTable, refuses_what_is_no_table) {
  EXPECT_THROW(PipelineTable("a | b | c\n"), std::logic_error);
  EXPECT_THROW(PipelineTable("a | b | unknown | \n"), std::logic_error);
  EXPECT_THROW(PipelineTable(kText).path("unknown"), std::logic_error);
}

TEST(PipelineTable, of_roomcut_reads_nothing_that_no_earlier_run_has_written) {
  const PipelineTable& table = pipeline_table();
  ASSERT_GT(table.runs().size(), 10U);
  std::set<std::string> written{"scan"};
  for (const PipelineRun& run : table.runs()) {
    for (const RunFile& file : run.reads) {
      const bool from_outside = file.path.starts_with("inputs/") || file.path.starts_with("edits/");
      EXPECT_TRUE(from_outside || written.contains(file.path)) << run.name << " reads " << file.path;
    }
    for (const RunFile& file : run.writes) {
      EXPECT_TRUE(written.insert(file.path).second) << file.path << " is written twice";
    }
  }
}

}  // namespace
}  // namespace roomcut
