// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "stages/ingest/moments.h"

namespace roomcut::ingest {

/// The best plane of a neighbourhood: variances ascending (units^2) and the direction of the smallest.
struct Plane {
  double lambda0 = 0, lambda1 = 0;
  std::array<double, 3> normal{0, 0, 0};  ///< unit length; zero when the points lie on a line or in one place
};

/// Smallest eigenvalue by Newton's method from 0, where the characteristic polynomial of a covariance falls
/// and is convex: the steps never pass the root. The others follow from the trace. No trigonometry, no
/// iteration to convergence.
Plane plane_of(const Spread& spread);

}  // namespace roomcut::ingest
