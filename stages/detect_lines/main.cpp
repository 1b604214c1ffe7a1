// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/run_stage.h"
#include "common/slices/slices_io.h"
#include "common/wall_lines/wall_lines_io.h"
#include "stages/detect_lines/detect_lines.h"
#include "stages/detect_lines/hough_io.h"

namespace {

using namespace roomcut;
using namespace roomcut::detect_lines;

void report(StageRun& run, const DetectLinesResult& result) {
  for (const DetectLinesChoice& choice : result.choices) run.chose(choice.parameter, choice.value);
  double support_m = 0;
  for (const WallLine& line : result.lines.lines) support_m += line.support_m;
  run.count("wall lines", static_cast<double>(result.lines.lines.size()));
  run.count("covered length", support_m, "m");
  run.count("curved walls", static_cast<double>(result.arcs));
  run.count("near-duplicates joined", static_cast<double>(result.merged));
}

}  // namespace

int main(int argc, char** argv) {
  DetectLinesParams params;
  const StageInfo info{"detect_lines",
                       14,
                       "Finds the wall lines of all wall slices with a Hough transform.",
                       {{"slices", "levels and wall slices, from slice"}},
                       {{"lines-out", "wall lines, to be edited or taken as they are"},
                        {"hough", "accumulator and classified cells, for the report"}},
                       {}};
  return run_stage(argc, argv, info, parameters(params), [&params](StageRun& run) {
    const Slices slices = read_slices(run.input("slices"));
    const DetectLinesResult result = detect_lines::detect_lines(slices, params);
    write_hough(run.output("hough"), result, run.provenance());
    write_wall_lines(run.output("lines-out"), result.lines, run.provenance());
    report(run, result);
  });
}
