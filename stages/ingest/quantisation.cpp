// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/quantisation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace roomcut::ingest {

namespace {

// Tenths of decimals, and what float32 keeps of grid coordinates that were then written as text or doubles.
constexpr std::array<double, 15> kSteps{0.5,  0.25,  0.125, 0.1,   0.0625, 0.05,   0.03125, 0.02,
                                        0.01, 0.005, 0.002, 0.001, 0.0005, 0.0002, 0.0001};
constexpr std::size_t kSampled = 4096;
constexpr std::size_t kFewestLevels = 20;  // an axis with fewer values may be a few flat surfaces
constexpr double kCoarse_m = 0.1;          // a room is not many such steps wide
constexpr std::size_t kFewestCoarseLevels = 7;
constexpr double kShare = 0.99;

/// Whether nearly all values lie on a grid of this step through the first, on many of its levels.
bool on_grid(const std::vector<double>& values, double step, double rounding) {
  const double slack = 0.01 * step + 2 * rounding;
  if (slack > 0.1 * step) {
    return false;
  }
  std::size_t hits = 0;
  std::set<std::int64_t> levels;
  for (const double value : values) {
    const double position = (value - values.front()) / step;
    const double level = std::round(position);
    if (std::abs(position - level) * step <= slack) {
      ++hits;
      levels.insert(static_cast<std::int64_t>(level));
    }
  }
  return static_cast<double>(hits) >= kShare * static_cast<double>(values.size()) &&
         levels.size() >= (step < kCoarse_m ? kFewestLevels : kFewestCoarseLevels);
}

}  // namespace

double quantisation_step(const ScanBlock& sample, const ScanFrame& frame, const ScanReader& reader) {
  double largest = 0;
  const std::size_t stride = std::max<std::size_t>(1, sample.size() / kSampled);
  for (const std::vector<double>* axis : {&sample.x, &sample.y, &sample.z}) {
    std::vector<double> values;
    double magnitude = 0;
    for (std::size_t i = 0; i < axis->size(); i += stride) {
      if (std::isfinite((*axis)[i]) && std::abs((*axis)[i]) < 1e9) {
        values.push_back((*axis)[i] * frame.metres);
        magnitude = std::max(magnitude, std::abs((*axis)[i]));
      }
    }
    if (values.empty()) {
      continue;
    }
    const double typical = std::abs(values[values.size() / 2]) / frame.metres;
    const double spacing = reader.resolution(typical) * frame.metres;
    const double rounding = reader.resolution(magnitude) * frame.metres;
    const auto found = std::find_if(kSteps.begin(), kSteps.end(),
                                    [&](double step) { return on_grid(values, step, rounding); });
    largest = std::max({largest, spacing, found == kSteps.end() ? 0.0 : *found});
  }
  return largest;
}

}  // namespace roomcut::ingest
