// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/vault_warning.h"

#include <algorithm>
#include <cstdio>

namespace roomcut::slice {

namespace {

constexpr double kBent_m = 0.01;  // off its points: by less, a facet is as good as a plane
constexpr double kNoises = 3;
constexpr double kSmallest_m2 = 10;

}  // namespace

std::string vault_warning(const Slices& slices) {
  double area = 0;
  double worst = 0;
  int facets = 0;
  for (const SlopedPlane& plane : slices.planes) {
    if (plane.rms_m > std::max(kBent_m, kNoises * slices.noise_m)) {
      area += plane.area_m2;
      worst = std::max(worst, plane.rms_m);
      ++facets;
    }
  }
  if (area < kSmallest_m2) {
    return "";
  }
  char text[240];
  std::snprintf(
      text, sizeof text,
      "%.0f m^2 of vault or dome are modelled as %d facets, which its points leave by up to %.1f cm; "
      "see in the page whether the model follows it down to the walls",
      area, facets, 100 * worst);
  return text;
}

}  // namespace roomcut::slice
