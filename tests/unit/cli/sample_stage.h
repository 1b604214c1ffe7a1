// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "common/artefact/h5.h"
#include "common/cli/run_stage.h"
#include "tests/unit/artefact/temporary_folder.h"

namespace roomcut::test {

/// A stage with one of everything.
inline StageInfo sample_info() {
  StageInfo info;
  info.name = "slice";
  info.revision = 7;
  info.summary = "A sample.";
  info.inputs = {{.name = "cloud", .description = "points"},
                 {.name = "edit",
                  .description = "edit",
                  .optional = true,
                  .by_bytes = true,
                  .default_path = "edits/e.txt"}};
  info.outputs = {{.name = "slices", .description = "slices"}};
  info.options = {{"up", "z", "which way is up", {"x", "y", "z"}}};
  return info;
}

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs a stage in this process. `width` is its one parameter.
inline Outcome run_sample(
    const std::vector<std::string>& arguments,
    const std::function<void(StageRun&, double)>& body = [](StageRun&, double) {},
    const StageInfo& info = sample_info()) {
  std::vector<std::string> words{info.name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  double width = 0.5;
  std::optional<double> depth;
  ParameterTable table{number("width_m", width, "m", 0, 10, "How wide."),
                       auto_number("depth_m", depth, "m", 0, 10, "How deep.", "twice the noise")};
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  Outcome outcome;
  outcome.exit_code = run_stage(static_cast<int>(words.size()), argv.data(), info, table,
                                [&](StageRun& run) { body(run, width); });
  outcome.err = ::testing::internal::GetCapturedStderr();
  outcome.out = ::testing::internal::GetCapturedStdout();
  return outcome;
}

}  // namespace roomcut::test
