// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <optional>
#include <string>

#include "common/params/params.h"

namespace roomcut::detect_lines {

/// Parameters of `detect_lines`; an empty optional is derived from noise and extent (detect_lines.h:
/// choices).
struct DetectLinesParams {
  std::optional<double> inlier_m;          ///< farthest a cell may lie from its line [m]
  std::optional<double> merge_m;           ///< lines nearer than this are one [m]
  std::optional<double> hough_angle_deg;   ///< accumulator step, as the user writes it [deg]
  std::optional<double> hough_distance_m;  ///< accumulator step [m]
  bool wider = true;                       ///< 4 and 8 tau and the points' normals are tried after 2 tau
  bool short_lines = true;                 ///< columns, niches and pilasters too
  bool arcs = true;                        ///< curved walls are circles, in chords
  std::string votes = "coverage";          ///< "coverage": by covered length; "equal": each fitted line once
  std::string search = "greedy";           ///< "greedy", or "mean_shift" over the accumulator
  double linearity = 0.1;                  ///< paper: lambda2 / lambda1 below this is a piece of wall
  double vote_window_rad =
      4.0 * std::numbers::pi / 180.0;  ///< a cell votes this far to both sides of its angle
  double inlier_angle_rad =
      17.0 * std::numbers::pi / 180.0;  ///< farthest a cell's angle may be from its line's
  double merge_angle_rad = 1.7 * std::numbers::pi / 180.0;
  double min_support_m = 0.5;  ///< shortest covered length of a line
  double max_gap_m = 3.0;      ///< supports farther apart are lines of their own
};

/// The block `detect_lines` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(DetectLinesParams& p) {
  return {
      number("linearity", p.linearity, "1", 0.001, 1.0,
             "A neighbourhood is a piece of wall when lambda2 / lambda1 of its covariance is below this."),
      boolean(
          "wider", p.wider,
          "Where noise or corners hide a wall in 2 tau, 4 and 8 tau and the points' own normals are tried."),
      boolean(
          "short_lines", p.short_lines,
          "Sides of columns, niches and pilasters are lines, however short; false: those of min_support_m "
          "alone."),
      boolean("arcs", p.arcs, "Curved walls are circles, in chords; false: each piece is a line of its own."),
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
                  "8 cm / (2 x radius, a preferred number), 0.1 ... 0.25 deg"),
  };
}

}  // namespace roomcut::detect_lines
