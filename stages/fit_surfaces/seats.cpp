// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/seats.h"

#include <algorithm>
#include <cmath>

namespace roomcut::fit_surfaces {
namespace {

constexpr double kMargin_m = 0.5;  // an outline is the hull of points: planes go on to the next wall

/// Whether a plane at height z over the middle of a face is nearer to this level than to its neighbours. A
/// level that stands for planes alone is reached from as far as the next level that does not: up to there the
/// last step's strip goes.
bool is_at(const CellComplex& complex, std::size_t level, double z) {
  const std::vector<double>& levels = complex.levels;
  const auto is_step = [&](std::size_t l) { return !complex.steps.empty() && complex.steps[l] != 0; };
  const auto border = [&](std::size_t next) {
    return is_step(level) && !is_step(next)   ? levels[next]
           : !is_step(level) && is_step(next) ? levels[level] + 0.25 * (levels[next] - levels[level])
                                              : 0.5 * (levels[level] + levels[next]);
  };
  return (level == 0 || z >= border(level - 1)) && (level + 1 == levels.size() || z <= border(level + 1));
}

}  // namespace

void Seats::add(const CellComplex& complex, std::size_t face, std::size_t level, bool ceiling) {
  const Vec2 middle = complex.centroid(face);
  const std::size_t before = seats_.size();
  for (std::size_t k = 0; k < complex.planes.size(); ++k) {
    const SlopedPlane& plane = complex.planes[k];
    if (plane.ceiling == ceiling && plane.covers(middle, kMargin_m) &&
        is_at(complex, level, plane.height(middle))) {
      seats_.push_back({static_cast<std::int32_t>(level), static_cast<std::int32_t>(k), ceiling,
                        plane.gradient, plane.c, 1 / std::sqrt(1 + plane.gradient.squaredNorm())});
    }
  }
  const bool step = !complex.steps.empty() && complex.steps[level] != 0;
  if (!step || seats_.size() == before) {
    seats_.push_back({static_cast<std::int32_t>(level), -1, ceiling, Vec2(0, 0), complex.levels[level], 1});
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
