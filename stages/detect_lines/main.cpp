// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/run_stage.h"
#include "common/slices/slices_io.h"
#include "common/wall_lines/wall_lines_io.h"
#include "stages/detect_lines/detect_lines.h"
#include "stages/detect_lines/hough_io.h"

namespace {

using namespace roomcut;
using namespace roomcut::detect_lines;

ParameterTable parameters(DetectLinesParams& p) {
  return {
      number("linearity", p.linearity, "1", 0.001, 1.0,
             "A neighbourhood is a piece of wall when lambda2 / lambda1 of its covariance is below this."),
      boolean(
          "wider", p.wider,
          "Where noise or corners hide a wall in 2 tau, 4 and 8 tau and the points' own normals are tried."),
      choice(
          "votes", p.votes, {"coverage", "equal"},
          "coverage: a cell votes by the length of wall it speaks for; equal: the paper's, once for the line "
          "fitted to its neighbourhood."),
      choice(
          "search", p.search, {"greedy", "mean_shift"},
          "greedy: highest bin, fit, votes taken back; mean_shift: the paper's, modes of the accumulator."),
      number("min_support_m", p.min_support_m, "m", 0.05, 100.0, "Shortest covered length of a wall line."),
      number("max_gap_m", p.max_gap_m, "m", 0.0, 1000.0,
             "Supports farther apart on one line become wall lines of their own."),
      auto_number("inlier_m", p.inlier_m, "m", 0.001, 0.5, "Farthest a cell may lie from its wall line.",
                  "max(2.5 cm, 2.5 x noise)"),
      angle("inlier_angle_deg", p.inlier_angle_rad, 1.0, 90.0,
            "Farthest a cell's direction may be from its wall line's."),
      angle("vote_window_deg", p.vote_window_rad, 0.0, 45.0,
            "A cell votes for all angles this far to both sides of its own."),
      auto_number("merge_m", p.merge_m, "m", 0.0, 0.5, "Wall lines nearer than this are joined.",
                  "3.5 x noise, 2 ... 6 cm"),
      angle("merge_angle_deg", p.merge_angle_rad, 0.0, 45.0,
            "Wall lines that differ less than this in angle may be joined."),
      auto_number("hough_distance_m", p.hough_distance_m, "m", 0.001, 0.2,
                  "Distance step of the Hough accumulator.", "noise (a preferred number), 1 ... 2 cm"),
      auto_number("hough_angle_deg", p.hough_angle_deg, "deg", 0.05, 5.0,
                  "Angle step of the Hough accumulator.",
                  "8 cm / (2 x half diagonal, a preferred number), 0.1 ... 0.25 deg"),
  };
}

void report(StageRun& run, const DetectLinesResult& result) {
  for (const DetectLinesChoice& choice : result.choices) run.chose(choice.parameter, choice.value);
  double support_m = 0;
  for (const WallLine& line : result.lines.lines) support_m += line.support_m;
  run.count("wall lines", static_cast<double>(result.lines.lines.size()));
  run.count("covered length", support_m, "m");
  run.count("near-duplicates joined", static_cast<double>(result.merged));
}

}  // namespace

int main(int argc, char** argv) {
  DetectLinesParams params;
  const StageInfo info{"detect_lines",
                       6,
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
