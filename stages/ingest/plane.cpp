// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/plane.h"

#include <algorithm>
#include <cmath>

namespace roomcut::ingest {

namespace {

constexpr int kNewtonSteps =
    5;  // enough for 1e-3 of lambda1 when lambda0 = lambda1 / 2, far better for planes
constexpr double kFineEnough = 1e-4;  // of lambda1: a smaller step is the last

using Vector = std::array<double, 3>;

/// The direction that A - lambda0 maps to zero: the adjugate of that matrix is its outer product with itself,
/// so any row gives it; the one with the largest diagonal element gives it best.
Vector kernel(const std::array<double, 6>& c, double lambda0) {
  const double xx = c[0] - lambda0;
  const double yy = c[3] - lambda0;
  const double zz = c[5] - lambda0;
  const double adj_xx = yy * zz - c[4] * c[4];
  const double adj_yy = xx * zz - c[2] * c[2];
  const double adj_zz = xx * yy - c[1] * c[1];
  const double adj_xy = c[2] * c[4] - c[1] * zz;
  const double adj_xz = c[1] * c[4] - c[2] * yy;
  const double adj_yz = c[1] * c[2] - c[4] * xx;
  Vector row{adj_xz, adj_yz, adj_zz};
  if (adj_xx > adj_zz && adj_xx >= adj_yy) {
    row = {adj_xx, adj_xy, adj_xz};
  } else if (adj_yy > adj_zz) {
    row = {adj_xy, adj_yy, adj_yz};
  }
  const double squared = row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
  const double scale = squared > 0 ? 1 / std::sqrt(squared) : 0;
  return {row[0] * scale, row[1] * scale, row[2] * scale};
}

}  // namespace

Plane plane_of(const Spread& spread) {
  const std::array<double, 6>& c = spread.covariance;
  const double trace = c[0] + c[3] + c[5];
  const double minor_x = c[3] * c[5] - c[4] * c[4];
  const double minor_y = c[0] * c[5] - c[2] * c[2];
  const double minor_z = c[0] * c[3] - c[1] * c[1];
  const double minors = minor_x + minor_y + minor_z;
  const double determinant =
      std::max(0.0, c[0] * minor_x - c[1] * (c[1] * c[5] - c[4] * c[2]) + c[2] * (c[1] * c[4] - c[3] * c[2]));
  Plane plane;
  if (!(minors > 0)) {
    return plane;
  }
  double lambda = determinant / minors;  // Newton's first step
  for (int i = 1; i < kNewtonSteps; ++i) {
    const double value = determinant - lambda * (minors - lambda * (trace - lambda));
    const double slope = minors - lambda * (2 * trace - 3 * lambda);
    const double step = slope > 0 ? std::max(0.0, value / slope) : 0.0;
    lambda += step;
    if (step * trace < kFineEnough * minors) {  // minors / trace is about lambda1
      break;
    }
  }
  plane.lambda0 = lambda;
  const double rest = trace - lambda;             // lambda1 + lambda2
  const double product = minors - lambda * rest;  // lambda1 * lambda2
  const double root = std::sqrt(std::max(0.0, rest * rest - 4 * product));
  plane.lambda1 = rest + root > 0 ? 2 * product / (rest + root) : 0;  // the smaller one, without cancellation
  plane.normal = kernel(c, lambda);
  return plane;
}

}  // namespace roomcut::ingest
