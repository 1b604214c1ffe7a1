// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/raycast.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "stages/raycast/cell_evidence.h"
#include "stages/raycast/envelope.h"
#include "stages/raycast/features.h"
#include "stages/raycast/implied_faces.h"
#include "stages/raycast/line_of_sight.h"
#include "stages/raycast/wall_strips.h"

namespace roomcut::raycast {
namespace {

constexpr double kSurelyBeyond_m = 0.5;  // a jog of a facade, or a wall, is no balcony

double sigmoid(double x) {
  return 1 / (1 + std::exp(-x));
}

/// Shares are sums of products and may leave their range by a rounding error, which readers refuse.
float between(double low, double value, double high) {
  return static_cast<float>(std::clamp(value, low, high));
}

void store(const CellEvidence& e, std::size_t c, DataTerms& terms) {
  terms.kappa[c] = between(0, e.kappa, 1);
  terms.vertical[c] = between(-1, 0.5 * (e.up.front + e.down.front - e.up.back - e.down.back), 1);
  terms.around[c] = between(-1, e.around.front - e.around.back, 1);
  terms.winding[c] = static_cast<float>(e.winding);
  terms.surface_m2[c] = static_cast<float>(e.front_m2 - e.back_m2);
  terms.thin[c] = between(0, e.thin(), 1);
  terms.line_of_sight[c] = between(0, e.carved, 1);
  terms.observed[c] = between(0, e.around.front + e.around.back, 1);
  terms.closed[c] = between(0, 1 - e.level.nothing(), 1);
}

/// Names and weights, with room for the values.
void add_features(const FeatureWeights& model, std::size_t cells, DataTerms& terms) {
  for (const FeatureWeight& f : model.features) {
    terms.features.push_back({f.name, f.weight, f.meaning, std::vector<float>(cells)});
  }
  terms.constant = model.constant;
  terms.weights_source = model.source;
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
  const FeatureWeights& model = shipped_weights();
  add_features(model, cells, terms);
  const FaceWalk walk(complex, weights);
  const bool parity = params.evidence == "parity";
  if (params.implied_faces && !parity) {
    add_implied_faces(complex, walk, terms);
  }
  const RayRules rules{params.rays, parity, params.origins == "centre", params.level_rays};
  const std::vector<double> carved = carve_lines_of_sight(complex, walk, weights.stations);
  std::vector<CellEvidence> evidence(cells);
  std::vector<std::uint8_t> indoors(cells);
  const auto for_cells = [&](auto&& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells, 16), body);
  };
  for_cells([&](const tbb::blocked_range<std::size_t>& range) {
    std::vector<Crossing> scratch;
    for (std::size_t c = range.begin(); c < range.end(); ++c) {
      evidence[c] =
          gather_evidence(complex, weights, walk, complex.face_of(c), complex.layer_of(c), rules, scratch);
      evidence[c].carved = carved[c];
      indoors[c] = evidence[c].surely_indoors() ? 1 : 0;
    }
  });
  const std::vector<double> beyond = beyond_envelope(complex, weights, indoors);
  const std::vector<double> goes_on = walls_that_go_on(complex, weights, evidence);
  for_cells([&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t c = range.begin(); c < range.end(); ++c) {
      CellEvidence& e = evidence[c];
      e.beyond = std::min(1.0, beyond[complex.face_of(c)] / kSurelyBeyond_m);
      e.wall_goes_on = goes_on[c];
      store(e, c, terms);
      const FeatureValues values = features_of(e);
      for (std::size_t i = 0; i < values.size(); ++i) {
        terms.features[i].value[c] = static_cast<float>(values[i]);
      }
      const double beta = sigmoid(parity ? 10 * (e.kappa - 0.5) : model.log_odds(values));
      const double depth = parity ? 0 : params.surface_depth_m;
      terms.beta[c] = static_cast<float>(beta);
      terms.d_empty[c] = e.volume_m3 * (1 - beta) + depth * e.back_m2;
      terms.d_solid[c] = e.volume_m3 * beta + depth * e.front_m2;
    }
  });
  return terms;
}

}  // namespace roomcut::raycast
