// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ceres/solver.h>

namespace roomcut::refine_lines {

/// Options of every least-squares problem here: one thread, budgets in counts, silent; so the same result
/// anywhere.
inline ceres::Solver::Options solver_options(ceres::LinearSolverType linear) {
  ceres::Solver::Options options;
  options.num_threads = 1;
  options.linear_solver_type = linear;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  options.gradient_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace roomcut::refine_lines
