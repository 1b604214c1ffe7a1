// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace roomcut::compare {

/// How far the surfaces of two models lie apart [m], and how much empty space they share [m^3].
struct ModelDistance {
  struct OneWay {
    double mean_m = 0, rms_m = 0, p95_m = 0, hausdorff_m = 0;
  };
  OneWay b_to_a, a_to_b;
  double a_m3 = 0, b_m3 = 0, common_m3 = 0;
};

}  // namespace roomcut::compare
