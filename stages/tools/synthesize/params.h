// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/params/params.h"

namespace roomcut::synthesize {

/// What the command line may say over the scene file, so that one scene serves a whole row of sizes. Empty =
/// as the scene says.
struct SynthesizeParams {
  std::optional<double> points;
  std::optional<double> seed;
  std::optional<double> noise_m;
};

/// The block `synthesize` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(SynthesizeParams& p) {
  return {
      auto_number("points", p.points, "1", 1, 1e10, "Number of points.", "as the scene says"),
      auto_number("seed", p.seed, "1", 0, 9e15, "Seed of all random numbers.", "as the scene says"),
      auto_number("noise_m", p.noise_m, "m", 0, 1, "Standard deviation of the noise.", "as the scene says"),
  };
}

}  // namespace roomcut::synthesize
