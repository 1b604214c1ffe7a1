// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/params/params.h"

namespace roomcut::evaluate {

struct EvaluateParams {
  std::optional<double> sample_spacing_m, column_spacing_m;
  double thin_wall_m = 0.40;
  double found_share = 0.5;
  double colour_range_m = 0.05;
};

/// The block `evaluate` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(EvaluateParams& p) {
  return {
      auto_number("sample_spacing_m", p.sample_spacing_m, "m", 0.001, 1,
                  "Distance between samples of the surfaces",
                  "about 250,000 samples of the truth, at most 1 million of either surface"),
      auto_number("column_spacing_m", p.column_spacing_m, "m", 0.001, 1,
                  "Distance between the vertical lines that compare volumes", "about 250,000 lines"),
      number("thin_wall_m", p.thin_wall_m, "m", 0.05, 2,
             "Walls and slabs up to this thickness count as thin structure between rooms"),
      number("found_share", p.found_share, "1", 0.05, 1,
             "A room is found when more than this share of its volume is empty in the model"),
      number("colour_range_m", p.colour_range_m, "m", 0.001, 10,
             "Distance that gets the last colour of distance.ply and distance.png"),
  };
}

}  // namespace roomcut::evaluate
