// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/plane.h"

#include <algorithm>
#include <cmath>

namespace roomcut {

namespace {

constexpr int kNewtonSteps =
    5;  // enough for 1e-3 of lambda1 when lambda0 = lambda1 / 2, far better for planes

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double squared(const Vector& a) {
  return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

/// The direction that A - lambda0 maps to zero: the longest cross product of two of its rows.
Vector kernel(const std::array<double, 6>& c, double lambda0) {
  const Vector row0{c[0] - lambda0, c[1], c[2]};
  const Vector row1{c[1], c[3] - lambda0, c[4]};
  const Vector row2{c[2], c[4], c[5] - lambda0};
  Vector best = cross(row0, row1);
  for (const Vector& candidate : {cross(row0, row2), cross(row1, row2)}) {
    if (squared(candidate) > squared(best)) {
      best = candidate;
    }
  }
  const double length = std::sqrt(squared(best));
  if (length > 0) {
    for (double& component : best) {
      component /= length;
    }
  }
  return best;
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
    lambda += slope > 0 ? std::max(0.0, value / slope) : 0.0;
  }
  plane.lambda0 = lambda;
  const double rest = trace - lambda;             // lambda1 + lambda2
  const double product = minors - lambda * rest;  // lambda1 * lambda2
  const double root = std::sqrt(std::max(0.0, rest * rest - 4 * product));
  plane.lambda1 = rest + root > 0 ? 2 * product / (rest + root) : 0;  // the smaller one, without cancellation
  plane.normal = kernel(c, lambda);
  return plane;
}

}  // namespace roomcut
