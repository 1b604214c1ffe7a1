// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/rerun/stamp.h"

#include <gtest/gtest.h>

#include "common/rerun/work_digests.h"
#include "tests/unit/rerun/work_folder.h"

namespace roomcut::test {
namespace {

const Stamp kStamp{{{"12", "params/a.json", ""}, {"34", "scan", ""}}, {{"56", "10_ingest/a cloud.h5", "78"}}};

TEST(Stamp, comes_back_as_it_was_written) {
  const WorkFolder folder;
  settle_stamp("stamps/a", kStamp);
  const StampFile file = read_stamp("stamps/a");
  ASSERT_EQ(file.state, StampState::kWhole);
  ASSERT_EQ(file.stamp.inputs.size(), 2U);
  EXPECT_EQ(file.stamp.inputs[0].sha256, "12");
  EXPECT_EQ(file.stamp.inputs[1].name, "scan");
  ASSERT_EQ(file.stamp.outputs.size(), 1U);
  EXPECT_EQ(file.stamp.outputs[0].name, "10_ingest/a cloud.h5");
  EXPECT_EQ(file.stamp.outputs[0].sha256, "56");
  EXPECT_EQ(file.stamp.outputs[0].content, "78");
}

TEST(Stamp, of_a_stage_that_did_not_end_is_no_stamp) {
  const WorkFolder folder;
  EXPECT_EQ(read_stamp("stamps/a").state, StampState::kNone);
  withdraw_stamp("stamps/a");  // the first run: there is none to move aside
  EXPECT_EQ(read_stamp("stamps/a").state, StampState::kNone);
  settle_stamp("stamps/a", kStamp);
  withdraw_stamp("stamps/a");
  EXPECT_EQ(read_stamp("stamps/a").state, StampState::kUnfinished);
  settle_stamp("stamps/a", kStamp);
  EXPECT_EQ(read_stamp("stamps/a").state, StampState::kWhole);
  EXPECT_FALSE(std::filesystem::exists("stamps/a.before"));
}

TEST(Stamp, that_is_cut_short_or_of_an_older_roomcut_says_nothing) {
  const WorkFolder folder;
  settle_stamp("stamps/a", kStamp);
  const std::string whole = bytes_of("stamps/a");
  for (std::size_t length = 0; length + 1 < whole.size(); ++length) {
    put_bytes("stamps/a", whole.substr(0, length));
    EXPECT_EQ(read_stamp("stamps/a").state, StampState::kUnknown) << length;
  }
  put_bytes("stamps/a", "55cfecdef49a 1795893684 327142387 model.ply\n");
  EXPECT_EQ(read_stamp("stamps/a").state, StampState::kUnknown);
}

TEST(Stamp, that_names_files_outside_the_work_folder_is_refused) {
  const WorkFolder folder;
  for (const char* name : {"/etc/passwd", "../precious.txt", "a/../../precious.txt"}) {
    settle_stamp("stamps/a", {{}, {{"12", name, "34"}}});
    EXPECT_EQ(read_stamp("stamps/a").state, StampState::kUnknown) << name;
    EXPECT_TRUE(read_stamp("stamps/a").stamp.outputs.empty()) << name;
  }
}

TEST(Stamp, a_mark_is_left_when_a_payload_is_another_than_before_and_only_then) {
  const WorkFolder folder;
  const auto marked_by = [](const Stamp& stamp) {
    unmark_changed("stamps/a");
    withdraw_stamp("stamps/a");
    settle_stamp("stamps/a", stamp);
    return std::filesystem::exists("stamps/.a.changed");
  };
  Stamp stamp = kStamp;
  EXPECT_TRUE(marked_by(stamp)) << "nothing of before to compare with";
  EXPECT_FALSE(marked_by(stamp));
  stamp.outputs[0].content = "other-bytes";
  EXPECT_FALSE(marked_by(stamp)) << "the payload is as before";
  stamp.outputs[0].sha256 = "57";
  EXPECT_TRUE(marked_by(stamp));
  withdraw_stamp("stamps/a");  // killed, and begun again
  EXPECT_FALSE(marked_by(stamp));
  stamp.outputs.push_back({"1", "new", "2"});
  EXPECT_TRUE(marked_by(stamp));
}

TEST(ChangedInputs, are_those_with_another_digest_and_those_never_read) {
  const auto now = [](const std::string& name) { return name == "scan" ? "35" : "12"; };
  EXPECT_EQ(changed_inputs(kStamp, {"params/a.json", "scan", "new"}, now),
            (std::vector<std::string>{"scan", "new"}));
}

TEST(ChangedInputs, a_scan_that_is_gone_counts_as_unchanged_and_another_file_does_not) {
  const auto gone = [](const std::string&) { return std::string(kNoFile); };
  EXPECT_EQ(changed_inputs(kStamp, {"params/a.json", "scan"}, gone),
            std::vector<std::string>{"params/a.json"});
}

}  // namespace
}  // namespace roomcut::test
