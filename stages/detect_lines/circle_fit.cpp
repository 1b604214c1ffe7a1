// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/circle_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace roomcut::detect_lines {
namespace {

constexpr int kIterations = 15;
constexpr double kConverged = 1e-7;

/// What the distance is made of: p seen from the point, along the tangent and along the normal, and the
/// algebraic distance.
struct Place {
  double u, v, power;
};

Place place_of(const Bend& bend, const Vec2& p) {
  const Vec2& n = bend.normal;
  const Vec2 q = p - bend.point;
  const double u = n.x() * q.y() - n.y() * q.x();
  const double v = n.dot(q);
  return {u, v, v - 0.5 * bend.curvature * (u * u + v * v)};
}

double true_distance(double curvature, double power) {
  return 2 * power / (1 + std::sqrt(std::max(0.0, 1 - 2 * curvature * power)));
}

}  // namespace

double Bend::distance(const Vec2& p) const {
  return true_distance(curvature, place_of(*this, p).power);
}

Bend fit_bend(const WallCells& cells, const CellIndices& group, Bend start, double cauchy_m, bool straight) {
  Bend bend = start;
  for (int round = 0; round < kIterations; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const std::uint32_t i : group) {
      const Vec2 p(cells.x[i], cells.y[i]);
      const Place at = place_of(bend, p);
      const double distance = true_distance(bend.curvature, at.power);
      const double e = distance / cauchy_m;
      const double weight = static_cast<double>(cells.area_m2[i]) / (1 + e * e);
      // Derivatives of the algebraic distance by shift, turn and curvature: near the circle those of the true
      // one.
      const Eigen::Vector3d row(1 - bend.curvature * at.v, -at.u,
                                straight ? 0 : 0.5 * (at.u * at.u + at.v * at.v));
      normal += weight * row * row.transpose();
      right += weight * distance * row;
    }
    normal.diagonal() *= 1 + 1e-9;
    if (straight) normal(2, 2) = 1;
    const Eigen::Vector3d step = normal.ldlt().solve(right);
    if (!step.allFinite()) return start;
    bend.point += step(0) * bend.normal;
    bend.normal = (bend.normal + step(1) * Vec2(-bend.normal.y(), bend.normal.x())).normalized();
    bend.curvature += step(2);
    if (step.cwiseAbs().maxCoeff() < kConverged) break;
  }
  return bend;
}

}  // namespace roomcut::detect_lines
