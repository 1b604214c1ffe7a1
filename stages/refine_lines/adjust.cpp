// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/adjust.h"

#include <ceres/ceres.h>

#include <array>
#include <cmath>
#include <numbers>

#include "stages/refine_lines/solver_options.h"

namespace roomcut::refine_lines {

namespace {

/// All observations of a line. Parameter block {turn, shift}. Tukey's loss rho is inside: a residual r counts
/// as sqrt(rho(r^2)), so that Ceres handles some dozens of blocks instead of ten thousand; the minimum is the
/// same.
class ObservationsCost : public ceres::CostFunction {
 public:
  explicit ObservationsCost(const std::vector<LineResidual>& residuals) : residuals_(residuals) {
    set_num_residuals(static_cast<int>(residuals.size()));
    mutable_parameter_block_sizes()->push_back(2);
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const TurnedPose pose({parameters[0][0], parameters[0][1]});
    double* const jacobian = jacobians != nullptr ? jacobians[0] : nullptr;
    for (std::size_t i = 0; i < residuals_.size(); ++i) {
      const LineResidual& residual = residuals_[i];
      const Softened soft = soften(residual.value(pose));
      residuals[i] = soft.value;
      if (jacobian != nullptr) {
        jacobian[2 * i] = soft.slope * residual.by_turn(pose);
        jacobian[2 * i + 1] = soft.slope * residual.by_shift();
      }
    }
    return true;
  }

 private:
  struct Softened {
    double value, slope;  ///< sqrt(rho(r^2)) with the sign of r, and its derivative by r
  };
  static Softened soften(double r) {
    constexpr double kSquared = kTukeyLoss * kTukeyLoss;
    const double q = r * r / kSquared;
    if (q >= 1) {
      return {std::copysign(kTukeyLoss / std::numbers::sqrt3, r), 0};
    }
    const double share = std::sqrt(1 - q + q * q / 3);  // of r: rho = r^2 (1 - q + q^2 / 3)
    return {r * share, (1 - q) * (1 - q) / share};
  }

  const std::vector<LineResidual>& residuals_;
};

/// Holds a pose near where it came, each part with its own sigma.
class PriorCost : public ceres::SizedCostFunction<2, 2> {
 public:
  PriorCost(const Pose& home, const LinePrior& prior) : home_(home), prior_(prior) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    residuals[0] = (parameters[0][0] - home_.turn) / prior_.turn_rad;
    residuals[1] = (parameters[0][1] - home_.shift) / prior_.shift_m;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      jacobians[0][0] = 1 / prior_.turn_rad;
      jacobians[0][1] = 0;
      jacobians[0][2] = 0;
      jacobians[0][3] = 1 / prior_.shift_m;
    }
    return true;
  }

 private:
  Pose home_;
  LinePrior prior_;
};

/// Draws a line's direction to its class: ({turn, shift}, {angle of the class}).
class ParallelCost : public ceres::SizedCostFunction<1, 2, 1> {
 public:
  ParallelCost(double theta, double sigma) : theta_(theta), sigma_(sigma) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    residuals[0] = off_class(theta_ + parameters[0][0], parameters[1][0]) / sigma_;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      jacobians[0][0] = 1 / sigma_;
      jacobians[0][1] = 0;
    }
    if (jacobians != nullptr && jacobians[1] != nullptr) {
      jacobians[1][0] = -1 / sigma_;
    }
    return true;
  }

 private:
  double theta_, sigma_;
};

using Block = std::array<double, 2>;

void add_line(const Adjustment& adjustment, std::size_t i, ceres::Problem& problem, Block& block,
              std::vector<double>& angles) {
  const LineProblem& line = adjustment.lines[i];
  problem.AddParameterBlock(block.data(), 2);
  problem.AddResidualBlock(new PriorCost(unmoved(line), line.prior), nullptr, block.data());
  if (!line.residuals.empty()) {
    problem.AddResidualBlock(new ObservationsCost(line.residuals), nullptr, block.data());
  }
  const int group = adjustment.classes.class_of.empty() ? -1 : adjustment.classes.class_of[i];
  if (group >= 0 && adjustment.regularity_rad > 0) {
    problem.AddResidualBlock(new ParallelCost(line.line.theta, adjustment.regularity_rad), nullptr,
                             block.data(), &angles[static_cast<std::size_t>(group)]);
  }
  if (adjustment.constant[i]) {
    problem.SetParameterBlockConstant(block.data());
  }
}

}  // namespace

bool adjust(Adjustment& adjustment) {
  std::vector<Block> blocks;
  for (const Pose& pose : adjustment.poses) {
    blocks.push_back({pose.turn, pose.shift});
  }
  std::vector<double> angles = adjustment.classes.angle;
  ceres::Problem problem;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    add_line(adjustment, i, problem, blocks[i], angles);
  }
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(ceres::SPARSE_NORMAL_CHOLESKY), &problem, &summary);
  if (!summary.IsSolutionUsable()) {
    return false;
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    adjustment.poses[i] = {blocks[i][0], blocks[i][1]};
  }
  adjustment.classes.angle = angles;
  return true;
}

}  // namespace roomcut::refine_lines
