// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace roomcut::refine_lines {

/// A line's direction with its standard deviation, as fitted alone.
struct Direction {
  std::string id;               ///< decides ties
  double theta = 0, sigma = 0;  ///< [rad]
  bool takes_part = true;
};

/// Lines that are parallel or perpendicular as far as their standard deviations tell.
struct AngleClasses {
  std::vector<double> angle;  ///< of each class, modulo pi/2 [rad]
  std::vector<int> class_of;  ///< per line; -1 = none
};

/// Finds classes of directions modulo 90 degrees. A line joins only when it lies within 1.5 degrees AND
/// within 3 standard deviations (its own and the class's) of the class: a wall that is measurably oblique is
/// never pulled. Deterministic: the most precise direction begins, ties by id. Classes of one line are left
/// out.
AngleClasses find_angle_classes(const std::vector<Direction>& directions);

/// theta - angle, to the nearest multiple of 90 degrees, in (-pi/4, pi/4].
double off_class(double theta, double angle);

}  // namespace roomcut::refine_lines
