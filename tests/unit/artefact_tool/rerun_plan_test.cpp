// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact_tool/rerun_plan.h"

#include <gtest/gtest.h>

#include <map>

#include "common/artefact_tool/set_aside.h"
#include "common/rerun/work_digests.h"
#include "tests/unit/rerun/work_folder.h"

namespace roomcut::test {
namespace {

using Words = std::vector<std::string>;

/// lines -> cells -> labels -> refined (also from lines), labels -> model
const char* const kPipeline =
    "detect detect : lines : params/detect.json scan\n"
    "partition partition : cells : params/partition.json lines\n"
    "cut cut : labels margins : params/cut.json cells\n"
    "refine refine : refined : params/refine.json lines labels\n"
    "extract extract : model : params/extract.json labels\n";

Words names(const std::vector<StaleStage>& stale) {
  Words words;
  for (const StaleStage& stage : stale) {
    words.push_back(stage.name);
  }
  return words;
}

/// A folder in which every stage has just run; `now` is what its files hold, by digest.
class Plan : public ::testing::Test {
 protected:
  Plan() {
    for (const PipelineStage& stage : pipeline) {
      Stamp stamp;
      for (const std::string& name : stage.inputs) {
        now.emplace(name, "of-" + name);  // unless a stage before it makes it
        stamp.inputs.push_back({"of-" + name, name, ""});
      }
      for (const std::string& name : stage.outputs) {
        now[name] = "bytes-" + name;
        stamp.outputs.push_back({"of-" + name, name, now[name]});
      }
      settle_stamp("stamps/" + stage.name, stamp);
    }
  }
  std::vector<StaleStage> stale(const std::string& again = "") const {
    return find_stale(
        pipeline, [this](const std::string& name) { return now.at(name); }, again);
  }
  WorkFolder folder;
  std::vector<PipelineStage> pipeline = parse_pipeline(kPipeline);
  std::map<std::string, std::string> now;
};

TEST(Pipeline, is_read_from_its_table) {
  const auto pipeline = parse_pipeline(kPipeline);
  ASSERT_EQ(pipeline.size(), 5U);
  EXPECT_EQ(pipeline[2].outputs, (Words{"labels", "margins"}));
  EXPECT_EQ(pipeline[3].inputs, (Words{"params/refine.json", "lines", "labels"}));
}

TEST_F(Plan, nothing_runs_when_all_is_what_the_stamps_say) {
  EXPECT_EQ(names(stale()), Words{});
}

TEST_F(Plan, a_changed_parameter_makes_its_stage_stale_and_what_follows_waits) {
  now["params/cut.json"] = "other";
  const auto found = stale();
  ASSERT_EQ(names(found), Words{"cut"});
  EXPECT_EQ(found[0].changed, Words{"params/cut.json"});
  EXPECT_EQ(waits_for(pipeline, found)[4], Words{"cut"});
}

TEST_F(Plan, a_damaged_output_is_its_makers_affair_and_not_its_readers) {
  now["cells"] = "damaged";
  const auto found = stale();
  ASSERT_EQ(names(found), Words{"partition"});
  EXPECT_EQ(found[0].damaged, Words{"cells"});
}

TEST_F(Plan, a_missing_output_is_made_again_also_one_that_only_the_stamp_names) {
  Stamp stamp = read_stamp("stamps/extract").stamp;
  stamp.outputs.push_back({"of-picture", "pictures/a.svg", "of-picture"});
  settle_stamp("stamps/extract", stamp);
  now["pictures/a.svg"] = kNoFile;
  now["margins"] = kNoFile;
  const auto found = stale();
  ASSERT_EQ(names(found), (Words{"cut", "extract"}));
  EXPECT_EQ(found[0].missing, Words{"margins"});
  EXPECT_EQ(found[1].missing, Words{"pictures/a.svg"});
}

TEST_F(Plan, a_reader_of_another_version_of_a_file_is_stale_although_its_maker_is_not) {
  now["labels"] = "other-bytes";
  Stamp cut = read_stamp("stamps/cut").stamp;
  cut.outputs[0] = {"other", "labels", "other-bytes"};
  settle_stamp("stamps/cut", cut);
  EXPECT_EQ(names(stale()), (Words{"refine", "extract"}));
}

TEST_F(Plan, other_bytes_of_the_same_payload_make_no_reader_stale) {
  now["labels"] = "other-bytes";
  Stamp cut = read_stamp("stamps/cut").stamp;
  cut.outputs[0].content = "other-bytes";  // the cut ran again; only its provenance is another
  settle_stamp("stamps/cut", cut);
  EXPECT_EQ(names(stale()), Words{});
}

TEST_F(Plan, a_stage_without_a_whole_stamp_runs) {
  std::filesystem::remove("stamps/detect");
  withdraw_stamp("stamps/cut");
  put_bytes("stamps/refine", "0123 17 5 refined\n");  // of an older roomcut
  put_bytes("stamps/extract", "");                    // the machine lost power
  const auto found = stale();
  ASSERT_EQ(names(found), (Words{"detect", "cut", "refine", "extract"}));
  EXPECT_EQ(found[0].stamp, StampState::kNone);
  EXPECT_EQ(found[1].stamp, StampState::kUnfinished);
  EXPECT_EQ(found[2].stamp, StampState::kUnknown);
  EXPECT_EQ(found[3].stamp, StampState::kUnknown);
}

TEST_F(Plan, an_input_that_the_last_run_did_not_read_makes_stale) {
  pipeline[1].inputs.push_back("new");
  now["new"] = "of-new";
  EXPECT_EQ(names(stale()), Words{"partition"});
}

TEST_F(Plan, a_scan_that_is_gone_changes_nothing_and_another_one_does) {
  now["scan"] = kNoFile;
  EXPECT_EQ(names(stale()), Words{});
  now["scan"] = "other";
  EXPECT_EQ(names(stale()), Words{"detect"});
}

TEST_F(Plan, a_stage_that_is_asked_for_runs) {
  EXPECT_EQ(names(stale("cut")), Words{"cut"});
}

TEST_F(Plan, a_stage_waits_for_the_nearest_stale_stages_before_it) {
  now["params/detect.json"] = now["params/cut.json"] = "other";
  const auto waits = waits_for(pipeline, stale());
  EXPECT_TRUE(waits[0].empty());
  EXPECT_EQ(waits[1], Words{"detect"});
  EXPECT_EQ(waits[3], (Words{"detect", "cut"}));
  EXPECT_EQ(waits[4], Words{"cut"});
  EXPECT_TRUE(waits_for(pipeline, {})[4].empty());
}

TEST_F(Plan, a_stage_whose_reader_was_killed_before_it_read_is_named) {
  EXPECT_EQ(differently_read(pipeline), Words{});
  Stamp cut = read_stamp("stamps/cut").stamp;
  cut.outputs[0].sha256 = "other";
  settle_stamp("stamps/cut", cut);  // refine and extract have not run since
  EXPECT_EQ(differently_read(pipeline), (Words{"cut", "cut"}));
  withdraw_stamp("stamps/cut");  // also when it begins again
  EXPECT_EQ(differently_read(pipeline), (Words{"cut", "cut"}));
}

TEST_F(Plan, what_waits_makes_its_readers_wait_whatever_they_read_before) {
  now["params/detect.json"] = "other";
  Stamp cut = read_stamp("stamps/cut").stamp;
  cut.inputs[1].sha256 = "other";  // of cells, an older version than partition made last
  settle_stamp("stamps/cut", cut);
  EXPECT_EQ(names(stale()), Words{"detect"}) << "partition may still make what cut has read";
  EXPECT_EQ(differently_read(pipeline), Words{"partition"});
}

TEST_F(Plan, a_goal_needs_what_comes_before_it_only) {
  Words needed;
  for (const PipelineStage& stage : needed_for(pipeline, {"refine"})) {
    needed.push_back(stage.name);
  }
  EXPECT_EQ(needed, (Words{"detect", "partition", "cut", "refine"}));
  EXPECT_EQ(needed_for(pipeline, {"run"}).size(), 5U);
}

TEST(SetAside, keeps_what_a_person_may_have_edited_and_names_every_file) {
  const WorkFolder folder;
  std::filesystem::create_directories("30_detect_lines");
  put_bytes("30_detect_lines/wall_lines.geojson", "mine");
  put_bytes("cells.h5", "damaged");
  StaleStage stage;
  stage.name = "detect";
  stage.damaged = {"30_detect_lines/wall_lines.geojson", "cells.h5"};
  const auto notes = set_aside({stage});
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_EQ(bytes_of("edits/old/30_detect_lines.wall_lines.1.geojson"), "mine");
  EXPECT_NE(notes[0].find("edits/old/30_detect_lines.wall_lines.1.geojson"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("cells.h5"), std::string::npos) << notes[1];
  EXPECT_TRUE(std::filesystem::exists("cells.h5")) << "replaced when it is made again";
  put_bytes("30_detect_lines/wall_lines.geojson", "mine again");
  set_aside({stage});
  EXPECT_EQ(bytes_of("edits/old/30_detect_lines.wall_lines.1.geojson"), "mine");
  EXPECT_EQ(bytes_of("edits/old/30_detect_lines.wall_lines.2.geojson"), "mine again");
}

}  // namespace
}  // namespace roomcut::test
