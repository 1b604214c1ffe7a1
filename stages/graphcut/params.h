// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params/params.h"

namespace roomcut::graphcut {

struct GraphcutParams {
  double mu_m = 0.3;
  double min_observed = 0.1;
};

/// The block `graphcut` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(GraphcutParams& p) {
  return {
      number("mu_m", p.mu_m, "m", 0.01, 5.0,
             "What a square metre of surface without points costs, in cubic metres of cells (the paper's "
             "alpha times the building's height)."),
      number("min_observed", p.min_observed, "1", 0.0, 1.0,
             "Cells of whose rays a smaller share ends on a seen face are reported as unobserved."),
  };
}

}  // namespace roomcut::graphcut
