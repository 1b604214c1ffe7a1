// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/detect_lines/hough.h"

namespace roomcut::detect_lines {

/// A mode of the accumulator's votes.
struct HoughMode {
  Line2 line;
  double votes_m = 0;  ///< within twice the bandwidth [m]
};

/// Standard deviations of the Gaussian kernel: lines farther apart than twice that are modes of their own.
struct Bandwidth {
  double angle_rad = 0, distance_m = 0;
};

/// The paper's line extraction: mean shift over angle and distance, from every bin that none of its
/// neighbours exceeds, to the modes with at least `min_votes_m`; starts that end at one place are one mode.
/// Strongest first, ties by angle and distance. Deterministic.
std::vector<HoughMode> hough_modes(const HoughAccumulator& votes, const Bandwidth& bandwidth,
                                   double min_votes_m);

}  // namespace roomcut::detect_lines
