// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <optional>

#include "common/cli/run_stage.h"
#include "common/wall_lines/wall_lines_io.h"
#include "stages/accept_lines/accept_lines.h"

namespace {

using namespace roomcut;
using namespace roomcut::accept_lines;

StageInfo info() {
  StageInfo stage;
  stage.name = "accept_lines";
  stage.revision = 2;
  stage.summary = "Takes the hand-edited wall lines if there are any, else the detected ones";
  stage.inputs = {{"detected", "Detected wall lines"}, {"edit", "Wall lines edited by hand", true, true}};
  stage.outputs = {{"lines-out", "Accepted wall lines"}};
  return stage;
}

void body(StageRun& run) {
  const WallLinesFile detected = read_wall_lines(run.input("detected"));
  std::optional<WallLines> edit;
  if (run.has_input("edit")) {
    WallLinesFile file = read_edited_wall_lines(run.input("edit"), detected.content);
    for (const std::string& warning : file.warnings) {
      run.warn(warning);
    }
    edit = std::move(file.content);
  }
  const Acceptance accepted = accept_lines::accept_lines(detected.content, detected.payload_sha256, edit);
  if (accepted.base_moved) {
    run.warn(run.input("edit").string() + ": " + describe_moved_base(accepted, detected.payload_sha256));
  }
  for (const std::string& arc : accepted.arcs) {
    run.warn(run.input("edit").string() + ": " + arc);
  }
  write_wall_lines(run.output("lines-out"), accepted.lines, run.provenance());

  run.count("lines", static_cast<double>(accepted.lines.lines.size()));
  if (edit) {
    double farthest = 0;
    for (const LineMove& move : accepted.changes.moved) {
      farthest = std::max(farthest, move.ends_m);
    }
    run.count("kept", static_cast<double>(accepted.changes.same.size()));
    run.count("moved", static_cast<double>(accepted.changes.moved.size()));
    run.count("moved at most", farthest, "m");
    run.count("added", static_cast<double>(accepted.changes.added.size()));
    run.count("deleted", static_cast<double>(accepted.changes.deleted.size()));
    run.count("locked", accepted.locked);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(argc, argv, info(), {}, body);
}
