// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/raycast.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "stages/raycast/implied_faces.h"
#include "stages/raycast/line_of_sight.h"

namespace roomcut::raycast {
namespace {

double sigmoid(double x) {
  return 1 / (1 + std::exp(-x));
}

/// Shares are sums of products and may leave their range by a rounding error, which readers refuse.
float between(double low, double value, double high) {
  return static_cast<float>(std::clamp(value, low, high));
}

}  // namespace

// tests/accuracy/weight_terms.py has the same terms and weights, and refuses what they do not give.
double empty_log_odds(const CellEvidence& e) {
  // A few stray points on a large cell's faces should not decide: they count against this much of its
  // surface.
  const double surface = e.front_m2 + e.back_m2 + 0.5 + 0.03 * e.total_m2;
  // A thin cell between backs is a wall. A wide one that shows backs lies between rooms: it is more likely a
  // room that was not entered than anything else.
  const double back = (-2.5 * e.thin() + 1.5 * (1 - e.thin())) * e.back_m2 / surface;
  // So is a thin one behind a back, unless it has a ceiling or a floor of its own: a room's rim behind a
  // cupboard.
  const double plate = e.thin() * (1 - e.flat);
  return 1.1 + 0.5 * e.front_m2 / surface + back + 2 * e.around.front -
         1.75 * (1 + plate) * e.around.near_back - 3.5 * e.in_slab() - 3 * e.open() - 2.5 * e.outdoors() -
         0.8 * e.sky + 3 * e.looked_through();
}

namespace {

void store(const CellEvidence& e, std::size_t c, DataTerms& terms) {
  terms.kappa[c] = between(0, e.kappa, 1);
  terms.vertical[c] = between(-1, 0.5 * (e.up.front + e.down.front - e.up.back - e.down.back), 1);
  terms.around[c] = between(-1, e.around.front - e.around.back, 1);
  terms.winding[c] = static_cast<float>(e.winding);
  terms.surface_m2[c] = static_cast<float>(e.front_m2 - e.back_m2);
  terms.thin[c] = between(0, e.thin(), 1);
  terms.behind[c] = between(0, e.around.near_back, 1);
  terms.in_slab[c] = between(0, e.in_slab(), 1);
  terms.open[c] = between(0, e.open(), 1);
  terms.outdoors[c] = between(0, e.outdoors(), 1);
  terms.sky[c] = between(0, e.sky, 1);
  terms.line_of_sight[c] = between(0, e.carved, 1);
  terms.observed[c] = between(0, e.around.front + e.around.back, 1);
}

void add_implied_faces(const CellComplex& complex, const FaceWalk& walk, DataTerms& terms) {
  ImpliedFaces implied = find_implied_faces(complex, walk);
  terms.wall_implied = std::move(implied.wall);
  terms.level_implied = std::move(implied.level);
}

}  // namespace

DataTerms cast_rays(const CellComplex& complex, const FaceWeights& weights, const RaycastParams& params) {
  const std::size_t cells = complex.cells();
  DataTerms terms;
  terms.reset(complex);
  const FaceWalk walk(complex, weights);
  const bool parity = params.evidence == "parity";
  if (params.implied_faces && !parity) {
    add_implied_faces(complex, walk, terms);
  }
  const RayRules rules{params.rays, parity, params.origins == "centre", params.level_rays};
  const std::vector<double> carved = carve_lines_of_sight(complex, walk, weights.stations);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, cells, 16), [&](const tbb::blocked_range<std::size_t>& range) {
        std::vector<Crossing> scratch;
        for (std::size_t c = range.begin(); c < range.end(); ++c) {
          CellEvidence e = gather_evidence(complex, weights, walk, complex.face_of(c), complex.layer_of(c),
                                           rules, scratch);
          e.carved = carved[c];
          store(e, c, terms);
          const double beta = parity ? sigmoid(10 * (e.kappa - 0.5)) : sigmoid(empty_log_odds(e));
          const double depth = parity ? 0 : params.surface_depth_m;
          terms.beta[c] = static_cast<float>(beta);
          terms.d_empty[c] = e.volume_m3 * (1 - beta) + depth * e.back_m2;
          terms.d_solid[c] = e.volume_m3 * beta + depth * e.front_m2;
        }
      });
  return terms;
}

}  // namespace roomcut::raycast
