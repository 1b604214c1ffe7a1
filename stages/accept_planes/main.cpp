// SPDX-License-Identifier: GPL-3.0-or-later
#include <optional>

#include "common/cli/run_stage.h"
#include "common/slices/slices_io.h"
#include "common/sloped_planes/planes_io.h"
#include "stages/accept_planes/accept_planes.h"

namespace {

using namespace roomcut;
using namespace roomcut::accept_planes;

StageInfo info() {
  StageInfo stage;
  stage.name = "accept_planes";
  stage.revision = 1;
  stage.summary = "Takes the hand-edited sloped planes if there are any, else the detected ones";
  stage.inputs = {{"slices", "Detected planes, and levels"}, {"edit", "Planes edited by hand", true, true}};
  stage.outputs = {{"planes-out", "Accepted planes and the levels that stand for them"}};
  return stage;
}

void body(StageRun& run) {
  const Slices slices = read_slices(run.input("slices"), false);
  const AcceptedPlanes detected = detected_planes(slices);
  const std::string digest = planes_payload_sha256(detected);
  std::optional<AcceptedPlanes> edit;
  if (run.has_input("edit")) {
    PlanesFile file = read_edited_planes(run.input("edit"), detected);
    for (const std::string& warning : file.warnings) {
      run.warn(warning);
    }
    edit = std::move(file.content);
  }
  const Acceptance accepted = accept_planes::accept_planes(slices, detected, digest, edit);
  if (accepted.base_moved) {
    run.warn(run.input("edit").string() +
             ": the detection changed since the edit began; the edit stays in force, check it (when done, "
             "write \"base_sha256\": \"" +
             digest + "\" into its member `roomcut`)");
  }
  if (accepted.steps_moved) {
    run.warn(
        "the edit changed the steps that stand for slopes: wall slices are counted anew; where you "
        "restricted "
        "wall lines to some (`levels`), check them");
  }
  write_planes_file(run.output("planes-out"), accepted.planes, run.provenance());

  run.count("planes", static_cast<double>(accepted.planes.planes.size()));
  run.count("levels", static_cast<double>(accepted.planes.levels.size()));
  if (edit) {
    run.count("kept", accepted.kept);
    run.count("moved", accepted.edited);
    run.count("added", accepted.added);
    run.count("deleted", accepted.deleted);
    run.count("locked", accepted.locked);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(argc, argv, info(), {}, body);
}
