// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/refine_lines/line_residual.h"
#include "stages/refine_lines/observe.h"

namespace roomcut::refine_lines {

/// Cut-off of Tukey's loss in standard deviations: 95 % efficient on normal noise, and what lies beyond has
/// no pull at all. Single fits and Ceres use it (other losses: EXPERIMENTS.md).
inline constexpr double kTukeyLoss = 4.685;

/// Prior on a line's pose: keeps lines with few observations where they were detected.
struct LinePrior {
  double shift_m = 0.06;
  double turn_rad = 0.035;
};

/// One line and its observations, ready for fitting.
struct LineProblem {
  Line2 line;       ///< as it came
  Vec2 centre;      ///< weighted centroid of the observations; the line's own centre without any
  LinePrior prior;  ///< about the pose that puts the line where it came
  std::vector<LineResidual> residuals;  ///< ascending along the line
  std::vector<double> spacing;          ///< from each observation to the next [m]
};

/// Covariance of (turn, shift).
struct PoseCovariance {
  double turn_turn = 0, turn_shift = 0, shift_shift = 0;
};

struct LineFit {
  Pose pose;
  PoseCovariance covariance;
  double unevenness_m = 0;  ///< of the wall beyond the noise, as seen between observations
};

/// Residuals about the observations' centroid.
LineProblem make_problem(const Line2& line, const Vec2& centre_without,
                         const std::vector<Observation>& observations, const LinePrior& prior);

/// Pose that leaves the line where it came: the centre may lie beside it.
Pose unmoved(const LineProblem& problem);

/// Robust fit of one line (Tukey, iteratively reweighted, from several starts). Also adds the wall's own
/// unevenness to the residuals' sigma: what the observations scatter beyond their expected variance.

LineFit fit_line(LineProblem& problem);

/// Covariance at `pose`. The scale comes from the residuals (Huber's formula), drawn towards the expected one
/// when there are few, and grows when neighbouring residuals resemble each other. `turn_sigma_rad` > 0 adds a
/// prior on the turn.
PoseCovariance pose_covariance(const LineProblem& problem, const Pose& pose, double turn_sigma_rad = 0);

}  // namespace roomcut::refine_lines
