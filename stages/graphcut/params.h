// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace roomcut::graphcut {

/// Parameters of graphcut (names, units, ranges and meanings: graphcut_parameters() in main.cpp).
struct GraphcutParams {
  double mu_m = 0.3;
  double free_from = 0.3;
  double min_observed = 0.1;
};

}  // namespace roomcut::graphcut
