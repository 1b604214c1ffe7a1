// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/unit_question.h"

#include <algorithm>
#include <cstdio>

namespace roomcut::slice {

namespace {

constexpr double kFoot_m = 0.3048;
constexpr double kLowest_m = 2.1;  // of a usual storey
constexpr double kHighest_m = 3.5;
constexpr double kThickestSlab_m = 3;    // in either unit: no storey
constexpr double kSmallBuilding_m = 50;  // in feet a house of 15 m; a hall so high is wider

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f m", value);
  return text;
}

}  // namespace

std::string unit_question(const Slices& slices) {
  std::vector<double> storeys;
  for (std::size_t i = 0; i + 1 < slices.levels.size(); ++i) {
    const double height = slices.levels[i + 1].z - slices.levels[i].z;
    if (height > kThickestSlab_m) {
      storeys.push_back(height);
    }
  }
  const double widest = (slices.bbox_max - slices.bbox_min).head<2>().maxCoeff();
  const bool house = storeys.size() > 1 || (storeys.size() == 1 && widest < kSmallBuilding_m);
  if (slices.frame.unit != "m" || !house) {
    return "";
  }
  const auto [low, high] = std::minmax_element(storeys.begin(), storeys.end());
  if (*low * kFoot_m < kLowest_m || *high * kFoot_m > kHighest_m) {
    return "";
  }
  return "is the scan in feet? Taken as metres its " +
         (storeys.size() == 1
              ? std::string("storey is ") + metres(*low)
              : std::to_string(storeys.size()) + " storeys are " + metres(*low) + " to " + metres(*high)) +
         " high, in feet " + metres(*low * kFoot_m) + "; then give --unit ft to ingest (with make: UNIT=ft)";
}

}  // namespace roomcut::slice
