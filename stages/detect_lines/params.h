// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <optional>
#include <string>

namespace roomcut::detect_lines {

/// Parameters of `detect_lines`; an empty optional is derived from noise and extent (detect_lines.h:
/// choices).
struct DetectLinesParams {
  std::optional<double> inlier_m;          ///< farthest a cell may lie from its line [m]
  std::optional<double> merge_m;           ///< lines nearer than this are one [m]
  std::optional<double> hough_angle_deg;   ///< accumulator step, as the user writes it [deg]
  std::optional<double> hough_distance_m;  ///< accumulator step [m]
  bool wider = true;                       ///< 4 and 8 tau and the points' normals are tried after 2 tau
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

}  // namespace roomcut::detect_lines
