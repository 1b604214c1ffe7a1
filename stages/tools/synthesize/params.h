// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

namespace roomcut::synthesize {

/// What the command line may say over the scene file, so that one scene serves a whole row of sizes. Empty =
/// as the scene says.
struct SynthesizeParams {
  std::optional<double> points;
  std::optional<double> seed;
  std::optional<double> noise_m;
};

}  // namespace roomcut::synthesize
