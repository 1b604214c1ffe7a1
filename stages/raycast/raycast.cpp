// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/raycast.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "stages/raycast/implied_faces.h"

namespace roomcut {
namespace {

double sigmoid(double x) {
  return 1 / (1 + std::exp(-x));
}

/// Shares are sums of products and may leave their range by a rounding error, which readers refuse.
float between(double low, double value, double high) {
  return static_cast<float>(std::clamp(value, low, high));
}

}  // namespace

double empty_log_odds(const CellEvidence& e) {
  // A few stray points on a large cell's faces should not decide: they count against this much of its
  // surface.
  const double doubt = 0.5 + 0.03 * e.total_m2;
  const double own = (e.front_m2 - e.back_m2) / (e.front_m2 + e.back_m2 + doubt);
  const double seen = e.around.front + e.around.back;
  const double open = std::max(0.0, 1 - seen - 0.35);  // most rooms are closed to two thirds at least
  return 1.5 + 4 * own + 2 * e.around.front + e.vertical.front - 3 * e.around.near_back -
         3 * e.vertical.near_back - 4 * open - 5 * e.sky;
}

DataTerms cast_rays(const CellComplex& complex, const FaceWeights& weights, const RaycastParams& params) {
  const std::size_t cells = complex.cells();
  DataTerms terms;
  terms.kappa.resize(cells);
  terms.vertical.resize(cells);
  terms.around.resize(cells);
  terms.winding.resize(cells);
  terms.surface_m2.resize(cells);
  terms.behind.resize(cells);
  terms.sky.resize(cells);
  terms.observed.resize(cells);
  terms.beta.resize(cells);
  terms.d_empty.resize(cells);
  terms.d_solid.resize(cells);
  const FaceWalk walk(complex, weights);
  const std::size_t faces = complex.faces();
  assert(cells == 0 || faces > 0);
  const bool parity = params.evidence == "parity";
  if (parity) {
    terms.wall_implied.assign(weights.wall_omega.size(), 0);
    terms.level_implied.assign(weights.level_omega.size(), 0);
  } else {
    ImpliedFaces implied = find_implied_faces(complex, walk);
    terms.wall_implied = std::move(implied.wall);
    terms.level_implied = std::move(implied.level);
  }
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, cells, 16), [&](const tbb::blocked_range<std::size_t>& range) {
        std::vector<Crossing> scratch;
        for (std::size_t c = range.begin(); c < range.end(); ++c) {
          const std::size_t face = c % faces;
          const std::size_t layer = c / faces;
          const CellEvidence e = gather_evidence(complex, weights, walk, face, layer, params.rays, scratch);
          terms.kappa[c] = between(0, e.kappa, 1);
          terms.vertical[c] = between(-1, e.vertical.front - e.vertical.back, 1);
          terms.around[c] = between(-1, e.around.front - e.around.back, 1);
          terms.winding[c] = static_cast<float>(e.winding);
          terms.surface_m2[c] = static_cast<float>(e.front_m2 - e.back_m2);
          terms.behind[c] = between(0, e.around.near_back, 1);
          terms.sky[c] = between(0, e.sky, 1);
          terms.observed[c] = between(0, e.around.front + e.around.back, 1);
          const double beta = parity ? sigmoid(10 * (e.kappa - 0.5)) : sigmoid(empty_log_odds(e));
          const double depth = parity ? 0 : params.surface_depth_m;
          const double volume = complex.area(face) * complex.height(layer);
          terms.beta[c] = static_cast<float>(beta);
          terms.d_empty[c] = volume * (1 - beta) + depth * e.back_m2;
          terms.d_solid[c] = volume * beta + depth * e.front_m2;
        }
      });
  return terms;
}

}  // namespace roomcut
