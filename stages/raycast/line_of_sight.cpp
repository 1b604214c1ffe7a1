// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/line_of_sight.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/cells/face_locator.h"

namespace roomcut::raycast {
namespace {

constexpr std::size_t kDirections = 8192;
constexpr double kShort = 0.1;  // [m] a ray stops this far before its surface, whose place is not exact

/// Evenly spread directions (Fibonacci's spiral).
Vec3 direction(std::size_t i) {
  const double up = 1 - (2 * static_cast<double>(i) + 1) / kDirections;
  const double flat = std::sqrt(1 - up * up);
  const double azimuth = 2 * std::numbers::pi * std::fmod(static_cast<double>(i) * std::numbers::phi, 1.0);
  return {flat * std::cos(azimuth), flat * std::sin(azimuth), up};
}

/// Adds the volume that one ray carves out of the cells on its way.
void carve(const std::vector<Crossing>& crossings, std::vector<double>& volume) {
  // ends[i]: share of the ray that ends on the front of crossing i.
  double left = 1;
  double ending = 0;
  std::vector<double> ends;
  ends.reserve(crossings.size());
  for (const Crossing& c : crossings) {
    ends.push_back(left * c.seen_front);
    ending += ends.back();
    left *= std::max(0.0, 1.0 - c.omega);
  }
  const double angle = 4 * std::numbers::pi / kDirections;
  double from = 0;
  for (std::size_t i = 0; i < crossings.size() && ending > 0; ++i) {
    const auto cone = [&](double to) {
      return to > from ? (to * to * to - from * from * from) * angle / 3 : 0;
    };
    const double beyond = ending - ends[i];
    volume[crossings[i].cell] +=
        beyond * cone(crossings[i].distance) + ends[i] * cone(crossings[i].distance - kShort);
    ending = beyond;
    from = crossings[i].distance;
  }
}

}  // namespace

std::vector<double> carve_lines_of_sight(const CellComplex& complex, const FaceWalk& walk,
                                         const std::vector<Vec3>& stations) {
  const FaceLocator locator(complex);
  std::vector<std::vector<double>> volume(stations.size());
  tbb::parallel_for(std::size_t{0}, stations.size(), [&](std::size_t s) {
    const std::int64_t at = locator.cell_at(stations[s]);
    if (at < 0) {
      return;
    }
    const auto cell = static_cast<std::size_t>(at);
    volume[s].assign(complex.cells(), 0);
    std::vector<Crossing> crossings;
    for (std::size_t i = 0; i < kDirections; ++i) {
      walk.follow({stations[s], direction(i), complex.face_of(cell), complex.layer_of(cell)}, crossings);
      carve(crossings, volume[s]);
    }
  });
  std::vector<double> unseen(complex.cells(), 1);
  for (const std::vector<double>& of_station : volume) {
    for (std::size_t c = 0; c < of_station.size(); ++c) {
      const double whole = complex.volume(c);
      unseen[c] *= std::max(0.0, 1 - of_station[c] / whole);
    }
  }
  for (double& share : unseen) {
    share = 1 - share;
  }
  return unseen;
}

}  // namespace roomcut::raycast
