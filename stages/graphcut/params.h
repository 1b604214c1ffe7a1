// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params/params.h"

namespace roomcut::graphcut {

struct GraphcutParams {
  double mu_m = 0.3;
  double free_from = 0.3;
  double min_observed = 0.1;
  std::string unknown = "apart";
  double doubt = 1.0;
};

/// The block `graphcut` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(GraphcutParams& p) {
  return {
      number("mu_m", p.mu_m, "m", 0.01, 5.0,
             "What a square metre of surface without points costs, in cubic metres of cells (the paper's "
             "alpha times the building's height)."),
      number("free_from", p.free_from, "1", 0.01, 1.0,
             "A face of which this share was seen costs nothing, less in proportion; 1 = the paper's 1 - "
             "omega."),
      choice(
          "unknown", p.unknown, {"apart", "rooms", "decided"},
          "Spaces that may be rooms nobody entered, or open air: apart: out of the model, and listed; rooms: "
          "part of it; decided: no such answer, the cut alone decides."),
      number(
          "doubt", p.doubt, "1", 0.0, 20.0,
          "By how much the log-odds of what nobody saw from inside may be wrong; spaces that it decides are "
          "unknown."),
      number("min_observed", p.min_observed, "1", 0.0, 1.0,
             "Cells of whose rays a smaller share ends on a seen face are reported as unobserved."),
  };
}

}  // namespace roomcut::graphcut
