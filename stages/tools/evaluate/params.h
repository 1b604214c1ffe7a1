// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params/params.h"
#include "stages/tools/evaluate/evaluate.h"

namespace roomcut::evaluate {

/// The block `evaluate` of pipeline.yaml, bound to `params`.
inline ParameterTable evaluate_parameters(EvaluateParams& params) {
  return {
      auto_number("sample_spacing_m", params.sample_spacing_m, "m", 0.001, 1,
                  "Distance between samples of the surfaces",
                  "about 250,000 samples of the truth, at most 1 million of either surface"),
      auto_number("column_spacing_m", params.column_spacing_m, "m", 0.001, 1,
                  "Distance between the vertical lines that compare volumes", "about 250,000 lines"),
      number("thin_wall_m", params.thin_wall_m, "m", 0.05, 2,
             "Walls and slabs up to this thickness count as thin structure between rooms"),
      number("found_share", params.found_share, "1", 0.05, 1,
             "A room is found when more than this share of its volume is empty in the model"),
      number("colour_range_m", params.colour_range_m, "m", 0.001, 10,
             "Distance that gets the last colour of distance.ply and distance.png"),
  };
}

}  // namespace roomcut::evaluate
