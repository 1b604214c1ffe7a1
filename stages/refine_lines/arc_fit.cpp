// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/arc_fit.h"

#include <ceres/ceres.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "common/wall_lines/wall_arc.h"
#include "stages/refine_lines/solver_options.h"

namespace roomcut::refine_lines {

namespace {

constexpr std::size_t kFewestObservations = 5;
/// Share of an open arc that its circle is fitted to: at its ends its chords may lie on the straight walls
/// that go on from it.
constexpr double kMiddle = 0.9;
constexpr double kFar = 10, kCauchy = 2.385;  // scales of the first losses, in standard deviations
constexpr double kBuilt_m = 0.001;            // no wall is rounder

/// (|p - centre| - radius) / sigma; parameter block {x, y, radius}.
struct OnCircle {
  Vec2 p;
  double sigma;
  template <class T>
  bool operator()(const T* circle, T* residual) const {
    const T x = p.x() - circle[0];
    const T y = p.y() - circle[1];
    residual[0] = (ceres::sqrt(x * x + y * y) - circle[2]) / sigma;
    return true;
  }
};

double sigma_of(const Observation& o) {
  return std::sqrt(o.variance_m2 + kBuilt_m * kBuilt_m);
}

void add(ceres::Problem& problem, const OnCircle& residual, ceres::LossFunction* loss, double* circle) {
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<OnCircle, 1, 3>(new OnCircle(residual)), loss,
                           circle);
}

bool solve(ceres::Problem& problem) {
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(ceres::DENSE_QR), &problem, &summary);
  return summary.IsSolutionUsable();
}

/// Weighted normal matrix of the residuals at the circle, and their mean square.
std::pair<Eigen::Matrix3d, double> normal_of(const CircleFit& fit,
                                             const std::vector<Observation>& observations) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  double squares = 0, weights = 0;
  for (const Observation& o : observations) {
    const Vec2 out = o.point - fit.centre;
    const double sigma = sigma_of(o);
    const double r = (out.norm() - fit.radius_m) / sigma;
    const double share = r / kTukeyLoss;
    if (std::abs(share) >= 1) continue;
    const double weight = (1 - share * share) * (1 - share * share);
    const Eigen::Vector3d row(-out.x() / out.norm(), -out.y() / out.norm(), -1);
    normal += weight / (sigma * sigma) * row * row.transpose();
    squares += weight * r * r;
    weights += weight;
  }
  return {normal, weights > 3 ? squares / (weights - 3) : 1};
}

double azimuth(const Vec2& out) {
  return std::atan2(out.y(), out.x());
}

/// Azimuths of the chords' span: its middle, and half of its width.
struct Span {
  double middle, half;
  double off(const Vec2& out) const {
    return std::abs(std::remainder(azimuth(out) - middle, 2 * std::numbers::pi));
  }
};

/// The widest gap between the chords' middles is where the arc is open; of a whole circle it is one chord's.
Span span_of(const std::vector<LineItem>& chords, const Vec2& centre) {
  constexpr double kTurn = 2 * std::numbers::pi;
  std::vector<double> middles;
  middles.reserve(chords.size());
  for (const LineItem& chord : chords) middles.push_back(azimuth(chord.wall.centre() - centre));
  std::sort(middles.begin(), middles.end());
  double from = middles.front(), gap = 0;
  for (std::size_t k = 0; k < middles.size(); ++k) {
    const double next = k + 1 < middles.size() ? middles[k + 1] : middles.front() + kTurn;
    if (next - middles[k] > gap) {
      gap = next - middles[k];
      from = next;
    }
  }
  const WallLine& any = chords.front().wall;
  const double chord = 2 * std::asin(std::min(1.0, 0.5 * any.length() / (any.a - centre).norm()));
  const double width = gap < 1.5 * chord ? kTurn / kMiddle : kTurn - gap + chord;
  return {from + 0.5 * (kTurn - gap), 0.5 * width};
}

/// The chord's end on the new circle: at its azimuth, as far out as it was.
Vec2 moved(const Vec2& p, const WallArc& was, const CircleFit& is) {
  return is.centre + (p - was.centre) * (is.radius_m / was.radius_m);
}

void set_measures(WallLine& wall, const LineItem& item, const CircleFit& fit) {
  double squares = 0, points = 0;
  std::set<std::size_t> bins;
  for (const Observation& o : item.observations) {
    const double distance = (o.point - fit.centre).norm() - fit.radius_m;
    squares += o.points * (o.scatter_m2 + distance * distance);
    points += o.points;
    bins.insert(o.bin);
  }
  const double bin_m = item.faces.empty() ? 0 : item.faces.front().bin_m;
  wall.rms_m = points > 0 ? std::sqrt(squares / points) : 0;
  wall.support_m = std::min(wall.length(), bin_m * static_cast<double>(bins.size()));
  const Vec2 out = (wall.centre() - fit.centre).normalized();
  const Eigen::Vector3d shift(out.x(), out.y(), 1);
  wall.sigma_offset_m = std::sqrt(std::max(0.0, shift.dot(fit.covariance * shift)));
  const Eigen::Vector3d turn(-out.y() / fit.radius_m, out.x() / fit.radius_m, 0);
  wall.sigma_angle_rad = std::sqrt(std::max(0.0, turn.dot(fit.covariance * turn)));
}

}  // namespace

CircleFit fit_circle(const CircleFit& came, const std::vector<Vec2>& ends, double prior_m,
                     const std::vector<Observation>& observations) {
  CircleFit fit = came;
  if (observations.size() < kFewestObservations) return fit;
  double circle[3] = {came.centre.x(), came.centre.y(), came.radius_m};
  // From losses that see far to the one that ignores what is far: a start some sigmas off has no pull in
  // that.
  const auto solved = [&](auto make_loss) {
    ceres::Problem problem;
    for (const Observation& o : observations) add(problem, {o.point, sigma_of(o)}, make_loss(), circle);
    for (const Vec2& end : ends) add(problem, {end, prior_m}, nullptr, circle);
    return solve(problem) && circle[2] > 0;
  };
  const bool converged = solved([] { return new ceres::CauchyLoss(kFar); }) &&
                         solved([] { return new ceres::CauchyLoss(kCauchy); }) &&
                         solved([] { return new ceres::TukeyLoss(kTukeyLoss); });
  if (!converged) return fit;
  fit.centre = {circle[0], circle[1]};
  fit.radius_m = circle[2];
  const auto [normal, scale] = normal_of(fit, observations);
  Eigen::FullPivLU<Eigen::Matrix3d> lu(normal);
  if (!lu.isInvertible()) return came;
  fit.covariance = std::max(1.0, scale) * lu.inverse();
  fit.usable = true;
  return fit;
}

std::map<std::string, std::vector<LineItem>> take_arcs(std::vector<LineItem>& items, const Frame& frame) {
  std::map<std::string, std::vector<LineItem>> arcs;
  std::vector<LineItem> others;
  for (LineItem& item : items) {
    const auto arc = arc_of(item.wall, frame);
    (arc ? arcs[arc->id] : others).push_back(std::move(item));
  }
  items = std::move(others);
  return arcs;
}

std::vector<WallLine> refine_arc(const std::vector<LineItem>& chords, const Frame& frame, double prior_m) {
  const WallArc was = *arc_of(chords.front().wall, frame);
  std::vector<Observation> observations;
  std::vector<Vec2> ends;
  bool any_free = false;
  const Span span = span_of(chords, was.centre);
  for (const LineItem& chord : chords) {
    any_free = any_free || !chord.constant;
    std::copy_if(chord.observations.begin(), chord.observations.end(), std::back_inserter(observations),
                 [&](const Observation& o) { return span.off(o.point - was.centre) <= kMiddle * span.half; });
    for (const Vec2& end : {chord.wall.a, chord.wall.b}) {
      ends.emplace_back(was.centre + was.radius_m * (end - was.centre).normalized());
    }
  }
  std::vector<WallLine> refined;
  CircleFit came;
  came.centre = was.centre;
  came.radius_m = was.radius_m;
  // As strong as three points, however many chords there are.
  const double each_m = prior_m * std::sqrt(static_cast<double>(ends.size()) / 3);
  const CircleFit fit = any_free ? fit_circle(came, ends, each_m, observations) : came;
  for (const LineItem& chord : chords) {
    WallLine wall = chord.wall;
    if (fit.usable && !chord.constant) {
      wall.a = moved(wall.a, was, fit);
      wall.b = moved(wall.b, was, fit);
      wall.source = LineSource::kRefined;
      set_measures(wall, chord, fit);
      set_arc(wall, WallArc{was.id, fit.centre, fit.radius_m}, frame);
    }
    refined.push_back(std::move(wall));
  }
  return refined;
}

}  // namespace roomcut::refine_lines
