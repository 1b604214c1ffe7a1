// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "common/cli/run_stage.h"
#include "common/pipeline/pipeline_table.h"
#include "common/wall_lines/describe_changes.h"
#include "common/wall_lines/wall_lines_io.h"
#include "stages/accept_lines/accept_lines.h"

namespace {

using namespace roomcut;
using namespace roomcut::accept_lines;

StageInfo info() {
  StageInfo stage;
  stage.name = "diff_lines";
  stage.summary = "Prints what the hand edit adds, moves and deletes; writes nothing";
  stage.inputs = {{"detected", "Detected wall lines", false, false, pipeline_table().path("detected")},
                  {"edit", "Wall lines edited by hand", true, true, pipeline_table().path("edit")}};
  return stage;
}

void body(StageRun& run) {
  const WallLinesFile detected = read_wall_lines(run.input("detected"));
  if (!run.has_input("edit")) {
    std::cout << "no edit at " << run.input("edit").string() << ": all " << detected.content.lines.size()
              << " lines are as detected\n";
    return;
  }
  const WallLinesFile edit = read_edited_wall_lines(run.input("edit"), detected.content);
  for (const std::string& warning : edit.warnings) {
    run.warn(warning);
  }
  const Acceptance accepted =
      accept_lines::accept_lines(detected.content, detected.payload_sha256, edit.content);
  for (const std::string& line : describe_changes(accepted.changes, detected.content.lines,
                                                  edit.content.lines, detected.content.frame)) {
    std::cout << line << "\n";
  }
  if (accepted.base_moved) {
    std::cout << describe_moved_base(accepted, detected.payload_sha256, 1000) << "\n";
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(argc, argv, info(), {}, body);
}
