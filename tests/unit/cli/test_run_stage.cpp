// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "common/artefact/json_values.h"
#include "common/cli/run_stage.h"
#include "common/errors/codes.h"
#include "common/rerun/stamp.h"
#include "common/rerun/work_digests.h"
#include "tests/unit/cli/sample_stage.h"
#include "tests/unit/rerun/work_folder.h"

namespace roomcut::test {

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void write_cloud(const std::filesystem::path& path, double value = 1) {
  H5Writer writer(path, artefacts::kCloud, {}, {});
  writer.write<double>("v", {value}, "m", "values");
  writer.commit();
}

}  // namespace

TEST(RunStage, prints_its_parameters_and_needs_no_files_for_it) {
  const Outcome o = run_sample({"--dump-params", "--set", "width_m=2"});
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_EQ(o.out, "{\"params\":{\"depth_m\":\"auto\",\"width_m\":2},\"revision\":7,\"stage\":\"slice\"}\n");
  EXPECT_EQ(o.err, "");
}

TEST(RunStage, help_and_version_end_well) {
  const Outcome help = run_sample({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* part :
       {"--cloud", "10_ingest/cloud.h5", "--slices", "--up", "--threads", "width_m: 0.5", "How wide."}) {
    EXPECT_TRUE(has(help.out, part)) << part << "\n" << help.out;
  }
  const Outcome version = run_sample({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(has(version.out, "revision 7"));
}

TEST(RunStage, a_bad_command_line_is_an_error_of_usage) {
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"--none"},
                                              {"--threads", "0"},
                                              {"--threads", "x"},
                                              {"--up", "w"},
                                              {"word"},
                                              {"--work"},
                                              {"--config", "a", "--params", "b"},
                                              {"--set", "width_m"}}) {
    const Outcome o = run_sample(bad);
    EXPECT_EQ(o.exit_code, 2) << bad.front();
    EXPECT_TRUE(has(o.err, "error[U01]")) << o.err;
  }
}

TEST(RunStage, takes_parameters_from_file_and_command_line_in_this_order) {
  const TemporaryFolder folder;
  put_bytes(folder / "pipeline.yaml", "slice:\n  width_m: 3\n");
  double seen = 0;
  const auto body = [&](StageRun&, double width) { seen = width; };
  EXPECT_EQ(run_sample({"--config", folder / "pipeline.yaml"}, body).exit_code, 0);
  EXPECT_EQ(seen, 3);
  EXPECT_EQ(run_sample({"--config", folder / "pipeline.yaml", "--set", "slice.width_m=4"}, body).exit_code,
            0);
  EXPECT_EQ(seen, 4);
  put_bytes(folder / "slice.json", run_sample({"--dump-params", "--set", "width_m=5"}).out);
  EXPECT_EQ(run_sample({"--params", folder / "slice.json"}, body).exit_code, 0);
  EXPECT_EQ(seen, 5);
  EXPECT_EQ(run_sample({"--config", folder / "none.yaml"}, body).exit_code, 2);
}

TEST(RunStage, finds_files_below_the_work_folder_or_where_an_option_says) {
  const TemporaryFolder folder;
  run_sample({"--work", folder.path(), "--slices", "/else/where.h5", "-q"}, [&](StageRun& run, double) {
    EXPECT_EQ(run.input("cloud"), folder / "10_ingest/cloud.h5");
    EXPECT_EQ(run.output("slices"), "/else/where.h5");
    EXPECT_FALSE(run.has_input("edit"));
    EXPECT_EQ(run.option("up"), "z");
    EXPECT_THROW(run.input("slices"), std::logic_error);
  });
}

TEST(RunStage, demands_files_that_have_no_default) {
  StageInfo info = sample_info();
  info.inputs[0].name = "scan";  // of which the pipeline table says nothing
  const Outcome o = run_sample(
      {}, [](StageRun&, double) {}, info);
  EXPECT_EQ(o.exit_code, 2);
  EXPECT_TRUE(has(o.err, "error[U01] --scan: is required")) << o.err;
}

TEST(RunStage, provenance_names_stage_parameters_and_inputs_without_absolute_paths) {
  const TemporaryFolder folder;
  write_cloud(folder / "10_ingest/cloud.h5");
  std::filesystem::create_directory(folder / "edits");
  write_cloud(folder / "edits/e.txt");
  run_sample({"--work", folder.path(), "-q"}, [&](StageRun& run, double) {
    const Provenance& p = run.provenance();
    EXPECT_EQ(p.stage, "slice");
    EXPECT_EQ(p.stage_revision, 7);
    EXPECT_EQ(p.params_json, "{\"depth_m\":\"auto\",\"width_m\":0.5}");
    EXPECT_EQ(p.params_sha256, sha256_hex(p.params_json));
    ASSERT_EQ(p.inputs.size(), 2U);
    EXPECT_EQ(p.inputs[0].artefact, "cloud");
    EXPECT_EQ(p.inputs[0].path, "../10_ingest/cloud.h5");
    EXPECT_EQ(p.inputs[0].payload_sha256, inspect_artefact(folder / "10_ingest/cloud.h5").payload_sha256);
    EXPECT_EQ(p.inputs[1].payload_sha256, sha256_of_file(folder / "edits/e.txt"))
        << "what a person may have edited is taken by its bytes";
    run.set_input_digest("cloud", "42");
    EXPECT_EQ(run.provenance().inputs[0].payload_sha256, "42");
  });
}

TEST(RunStage, provenance_of_a_users_file_holds_its_name_only) {
  const TemporaryFolder folder;
  put_bytes(folder / "scan.ply", "ply");
  StageInfo info = sample_info();
  info.inputs = {{.name = "scan", .description = "scan"}};
  run_sample(
      {"--work", folder / "w", "--scan", folder / "scan.ply", "-q"},
      [&](StageRun& run, double) {
        EXPECT_EQ(run.provenance().inputs[0].path, "scan.ply");
        EXPECT_EQ(run.provenance().inputs[0].artefact, "scan");
        EXPECT_EQ(run.provenance().inputs[0].payload_sha256, sha256_hex("ply"));
      },
      info);
}

TEST(RunStage, prints_what_was_chosen_counted_and_warned_of_and_logs_it) {
  const TemporaryFolder folder;
  const auto body = [](StageRun& run, double) {
    run.chose("depth_m", 0.25);
    EXPECT_THROW(run.chose("unknown_m", 1), std::logic_error);
    run.count("cells", 320);
    run.count("area", 12.34567, "m^2");
    run.count("nothing", std::numeric_limits<double>::quiet_NaN());
    run.note("x is column 2");
    run.warn("first");
    run.warn("second");
  };
  const Outcome o = run_sample({"--work", folder.path(), "--threads", "3"}, body);
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_EQ(o.out, "");
  EXPECT_TRUE(has(o.err, "slice: depth_m = 0.25 (twice the noise)")) << o.err;
  EXPECT_TRUE(has(o.err, "slice: cells 320, area 12.35 m^2")) << o.err;
  EXPECT_TRUE(has(o.err, "slice: 2 warnings:")) << o.err;
  const Json log = Json::parse(bytes_of(folder / "logs/slice.json"));
  EXPECT_EQ(log["stage"], "slice");
  EXPECT_EQ(log["exit_code"], 0);
  EXPECT_EQ(log["threads"], 3);
  EXPECT_EQ(log["params"]["width_m"], 0.5);
  EXPECT_EQ(log["chosen"][0]["why"], "twice the noise");
  EXPECT_EQ(log["counts"][1]["value"], 12.34567);
  EXPECT_TRUE(has(o.err, "slice: x is column 2")) << o.err;
  EXPECT_EQ(log["notes"], Json::array({"x is column 2"}));
  EXPECT_EQ(log["warnings"], Json({"first", "second"}));
  EXPECT_GT(log["peak_memory_mb"], 1.0);
  EXPECT_EQ(run_sample({"--work", folder.path(), "-q"}, body).err, "");
}

TEST(RunStage, describes_its_files_options_and_parameters_as_JSON) {
  const Outcome o = run_sample({"--describe", "--set", "width_m=2"});
  EXPECT_EQ(o.exit_code, 0);
  const Json described = Json::parse(o.out);
  EXPECT_EQ(described["name"], "slice");
  EXPECT_EQ(described["revision"], 7);
  EXPECT_EQ(described["inputs"][0]["option"], "cloud");
  EXPECT_EQ(described["inputs"][0]["default"], "10_ingest/cloud.h5") << "from the pipeline table";
  EXPECT_EQ(described["inputs"][1]["optional"], true);
  EXPECT_EQ(described["outputs"][0]["default"], "20_slice/slices.h5");
  EXPECT_EQ(described["options"][0]["choices"], Json::array({"x", "y", "z"}));
  EXPECT_EQ(described["parameters"][0]["name"], "width_m");
  EXPECT_EQ(described["parameters"][0]["default"], 0.5) << "whatever --set says";
  EXPECT_EQ(described["parameters"][0]["highest"], 10);
  EXPECT_EQ(described["parameters"][1]["default"], "auto");
  EXPECT_EQ(described["parameters"][1]["formula"], "twice the noise");
}

TEST(RunStage, keeps_a_log_only_when_a_place_is_given) {
  const TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  run_sample({"-q"});
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  run_sample({"-q", "--log", "mine/a.json"});
  EXPECT_TRUE(std::filesystem::exists(folder / "mine/a.json"));
  std::filesystem::current_path(before);
}

TEST(RunStage, every_error_of_a_stage_is_printed_logged_and_gives_its_exit_code) {
  const TemporaryFolder folder;
  const Outcome o = run_sample({"--work", folder.path(), "-q"}, [](StageRun&, double) {
    throw StageError(
        {{errors::kLinesDegenerate, "e.geojson: features[1]", "both ends are equal", "move an end"},
         {errors::kLinesOutside, "e.geojson: features[2]", "far outside", ""}});
  });
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_EQ(o.err,
            "error[L07] e.geojson: features[1]: both ends are equal\nhint: move an end\n"
            "error[L08] e.geojson: features[2]: far outside\n");
  const Json log = Json::parse(bytes_of(folder / "logs/slice.json"));
  EXPECT_EQ(log["exit_code"], 3);
  EXPECT_EQ(log["problems"].size(), 2U);
  EXPECT_EQ(log["problems"][0]["code"], "L07");
}

TEST(RunStage, unexpected_exceptions_are_bugs_and_lack_of_memory_is_not) {
  const Outcome bug = run_sample({"-q"}, [](StageRun&, double) { throw std::runtime_error("what now"); });
  EXPECT_EQ(bug.exit_code, 1);
  EXPECT_TRUE(has(bug.err, "what now") && has(bug.err, "this is a bug")) << bug.err;
  const Outcome memory = run_sample({"-q"}, [](StageRun&, double) { throw std::bad_alloc(); });
  EXPECT_EQ(memory.exit_code, 4);
  EXPECT_TRUE(has(memory.err, "memory")) << memory.err;
}

TEST(RunStage, a_name_of_a_file_in_any_bytes_does_not_spoil_the_log) {
  const TemporaryFolder folder;
  run_sample({"--work", folder.path(), "--cloud", "\xff\xfe.h5", "-q"});
  EXPECT_FALSE(Json::parse(bytes_of(folder / "logs/slice.json"), nullptr, false).is_discarded());
}

/// The arguments that Make gives; the sample's work folder is the current one.
std::vector<std::string> for_make(const std::string& more = "-q") {
  return {"--work", ".", "-q", "--stamp", "stamps/slice", "--reads", "edits/e.txt 10_ingest/cloud.h5", more};
}

void write_slices(StageRun& run, double value) {
  H5Writer writer(run.output("slices"), artefacts::kSlices, run.provenance(), {});
  writer.write<double>("v", {value}, "m", "values");
  writer.commit();
}

TEST(RunStage, leaves_a_stamp_with_the_digests_of_what_it_read_and_wrote) {
  const WorkFolder folder;
  write_cloud("10_ingest/cloud.h5");
  const auto body = [](StageRun& run, double) {
    write_slices(run, 1);
    put_bytes("more.txt", "more");
    run.wrote("more.txt");
  };
  ASSERT_EQ(run_sample(for_make(), body).exit_code, 0);
  const StampFile file = read_stamp("stamps/slice");
  ASSERT_EQ(file.state, StampState::kWhole);
  ASSERT_EQ(file.stamp.inputs.size(), 2U);
  EXPECT_EQ(file.stamp.inputs[0].sha256, kNoFile) << "there is no edit";
  EXPECT_EQ(file.stamp.inputs[1].sha256, inspect_artefact("10_ingest/cloud.h5").payload_sha256);
  ASSERT_EQ(file.stamp.outputs.size(), 2U);
  EXPECT_EQ(file.stamp.outputs[0].sha256, inspect_artefact("20_slice/slices.h5").payload_sha256);
  EXPECT_EQ(file.stamp.outputs[0].content, sha256_of_file("20_slice/slices.h5"));
  EXPECT_EQ(file.stamp.outputs[1].name, "more.txt");
  EXPECT_EQ(file.stamp.outputs[1].sha256, sha256_hex("more"));
}

TEST(RunStage, an_edit_that_is_saved_while_the_stage_runs_makes_it_stale) {
  const WorkFolder folder;
  std::filesystem::create_directory("edits");
  put_bytes("edits/e.txt", "before");
  write_cloud("10_ingest/cloud.h5");
  run_sample(for_make(), [](StageRun& run, double) {
    put_bytes("edits/e.txt", "later!");
    write_slices(run, 1);
  });
  EXPECT_EQ(read_stamp("stamps/slice").stamp.inputs[0].sha256, sha256_hex("before"));
}

TEST(RunStage, if_changed_runs_only_when_an_input_differs_and_says_when_it_begins) {
  const WorkFolder folder;
  write_cloud("10_ingest/cloud.h5", 1);
  int runs = 0;
  const auto body = [&](StageRun& run, double) {
    ++runs;
    write_slices(run, 1);
  };
  std::vector<std::string> arguments = for_make("--if-changed");
  arguments.insert(arguments.end(), {"--announce", "@stage 1 1 slice"});
  EXPECT_EQ(run_sample(arguments, body).out, "@stage 1 1 slice\n");
  EXPECT_EQ(runs, 1) << "there was no stamp";
  std::filesystem::remove("logs/slice.json");
  EXPECT_EQ(run_sample(arguments, body).out, "");
  EXPECT_EQ(runs, 1);
  EXPECT_FALSE(std::filesystem::exists("logs/slice.json")) << "the log of the run that made the files stays";
  write_cloud("10_ingest/cloud.h5", 2);
  run_sample(arguments, body);
  EXPECT_EQ(runs, 2);
}

TEST(RunStage, that_fails_leaves_no_stamp) {
  const WorkFolder folder;
  write_cloud("10_ingest/cloud.h5");
  run_sample(for_make(), [](StageRun& run, double) { write_slices(run, 1); });
  run_sample(for_make(), [](StageRun&, double) { throw StageError(errors::kNoLevels, "", "no"); });
  EXPECT_EQ(read_stamp("stamps/slice").state, StampState::kUnfinished);
}

TEST(RunStage, limits_the_threads) {
  run_sample({"--threads", "1", "-q"}, [](StageRun& run, double) {
    EXPECT_EQ(run.threads(), 1);
    EXPECT_EQ(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism), 1U);
  });
}

TEST(Progress, piped_is_silent_for_short_work_and_with_q) {
  ::testing::internal::CaptureStderr();
  for (const bool quiet : {true, false}) {
    Progress progress("points", 1000, quiet);
    for (int i = 0; i < 1000; ++i) {
      progress.advance(1);
    }
  }
  Progress unknown("nothing", 0, false);
  unknown.advance(5);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Progress, piped_prints_a_line_with_rate_and_time_left_when_it_takes_long) {
  ::testing::internal::CaptureStderr();
  Progress progress("points", 1000, false);
  ::usleep(1050000);
  progress.advance(500);
  progress.advance(1);
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_TRUE(has(text, "points: 50 %, ")) << text;
  EXPECT_TRUE(has(text, "/s, ") && has(text, " left\n")) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

}  // namespace roomcut::test
