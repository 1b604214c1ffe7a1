// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/seats.h"

#include <algorithm>
#include <cmath>

#include "common/cells/stairs.h"

namespace roomcut::fit_surfaces {
namespace {

constexpr double kNear = 0.25;     // of the way to a step
constexpr double kMargin_m = 0.5;  // an outline is the hull of points: planes go on to the next wall

/// Whether a plane at height z over the middle of a face may be what the surface at this level stands for. A
/// step stands for planes alone: all the way to its neighbours, as the cut may have taken the next step. Any
/// other level is given up for a plane only where that comes near.
bool is_at(const std::vector<double>& levels, const Stairs& stairs, std::size_t level, double z) {
  const auto border = [&](std::size_t next) {
    const double share = stairs.is_step(level) ? 1 : stairs.is_step(next) ? kNear : 0.5;
    return levels[level] + share * (levels[next] - levels[level]);
  };
  return (level == 0 || z >= border(level - 1)) && (level + 1 == levels.size() || z <= border(level + 1));
}

}  // namespace

void Seats::add(const CellComplex& complex, std::size_t face, std::size_t level, bool ceiling) {
  const Stairs stairs(complex.levels, complex.steps);
  const Vec2 middle = complex.centroid(face);
  const double at = complex.levels[level];
  const auto first = static_cast<std::ptrdiff_t>(seats_.size());
  for (std::size_t k = 0; k < complex.planes.size(); ++k) {
    const SlopedPlane& plane = complex.planes[k];
    if (plane.ceiling == ceiling && plane.covers(middle, kMargin_m) &&
        is_at(complex.levels, stairs, level, plane.height(middle))) {
      seats_.push_back({static_cast<std::int32_t>(level), static_cast<std::int32_t>(k), ceiling,
                        plane.gradient, plane.c, 1 / std::sqrt(1 + plane.gradient.squaredNorm())});
    }
  }
  std::stable_sort(seats_.begin() + first, seats_.end(), [&](const Seat& a, const Seat& b) {
    return std::abs(a.height(middle) - at) < std::abs(b.height(middle) - at);
  });
  if (!stairs.is_step(level) || seats_.begin() + first == seats_.end()) {
    seats_.push_back({static_cast<std::int32_t>(level), -1, ceiling, Vec2(0, 0), at, 1});
  }
}

Seats::Seats(const CellComplex& complex, const std::vector<std::uint8_t>& label) {
  first_.push_back(0);
  for (std::size_t face = 0; face < complex.faces(); ++face) {
    bool below = false;
    for (std::size_t level = 0; level < complex.levels.size(); ++level) {
      const bool above = level < complex.layers() && is_empty(label, complex.cell(face, level));
      if (above != below) {
        add(complex, face, level, below);
      }
      below = above;
    }
    first_.push_back(seats_.size());
  }
}

}  // namespace roomcut::fit_surfaces
