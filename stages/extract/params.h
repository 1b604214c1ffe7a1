// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params/params.h"
#include "stages/extract/storeys.h"

namespace roomcut::extract {

struct ExtractParams {
  StoreyParams storeys;
};

/// The block `extract` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(ExtractParams& p) {
  return {
      number("storey_gap_m", p.storeys.least_gap_m, "m", 0.5, 10,
             "Floors closer together than this belong to one storey"),
      number("storey_floor_m2", p.storeys.least_floor_m2, "m^2", 0, 1000,
             "A storey has at least this much floor; less is counted to the storey below"),
  };
}

}  // namespace roomcut::extract
