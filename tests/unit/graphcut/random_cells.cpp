// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/graphcut/random_cells.h"

#include <string>

#include "common/random/counter_random.h"
#include "stages/partition/partition.h"
#include "tests/unit/partition/random_lines.h"

namespace roomcut::testing {
using namespace roomcut::partition;

CellComplex grid_complex(int nx, int ny, int nz) {
  WallLines lines;
  const auto add = [&](Vec2 a, Vec2 b) {
    WallLine line;
    line.id = "w" + std::to_string(100 + lines.lines.size());
    line.a = a;
    line.b = b;
    line.support_m = line.length();
    lines.lines.push_back(line);
  };
  lines.bbox_min = {0.5, 0.5};
  lines.bbox_max = {nx - 0.5, ny - 0.5};
  for (int i = 1; i < nx; ++i) {
    add(Vec2(i, 0.5), Vec2(i, ny - 0.5));
  }
  for (int i = 1; i < ny; ++i) {
    add(Vec2(0.5, i), Vec2(nx - 0.5, i));
  }
  std::vector<double> levels;
  for (int l = 0; l <= nz; ++l) {
    levels.push_back(l);
  }
  PartitionParams params;
  params.margin_m = 0.5;
  params.extend_m = 2;
  return partition::partition(lines, levels, params).complex;
}

CellComplex random_complex(std::uint64_t seed, int lines, int layers) {
  std::vector<double> levels{-1};
  for (int k = 0; k < layers; ++k) {
    levels.push_back(levels.back() + 1 + 2 * random_unit(seed, 77, static_cast<std::uint64_t>(k)));
  }
  return partition::partition(random_lines(seed, lines, seed % 2 == 1), levels, {}).complex;
}

namespace {

std::vector<float> uniform(std::size_t count, std::uint64_t seed, std::uint64_t stream) {
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = static_cast<float>(random_unit(seed, stream, i));
  }
  return values;
}

}  // namespace

FaceWeights random_weights(const CellComplex& complex, std::uint64_t seed) {
  FaceWeights weights;
  weights.wall_omega = uniform(complex.edges.size() * complex.layers(), seed, 1);
  weights.level_omega = uniform(complex.faces() * complex.levels.size(), seed, 2);
  return weights;
}

FaceWeights no_weights(const CellComplex& complex) {
  FaceWeights weights;
  weights.wall_omega.assign(complex.edges.size() * complex.layers(), 0.0F);
  weights.level_omega.assign(complex.faces() * complex.levels.size(), 0.0F);
  return weights;
}

DataTerms terms_of(const CellComplex& complex, const std::vector<float>& beta) {
  DataTerms terms;
  terms.reset(complex);
  terms.beta = beta;
  for (std::vector<float>* seen : {&terms.observed, &terms.around, &terms.closed}) {
    seen->assign(complex.cells(), 1.0F);
  }
  for (std::size_t c = 0; c < complex.cells(); ++c) {
    const double volume = complex.volume(c);
    terms.d_empty[c] = volume * (1 - beta[c]);
    terms.d_solid[c] = volume * beta[c];
  }
  return terms;
}

DataTerms random_terms(const CellComplex& complex, std::uint64_t seed) {
  return terms_of(complex, uniform(complex.cells(), seed, 3));
}

std::vector<std::uint8_t> random_labels(const CellComplex& complex, std::uint64_t seed, double share_empty) {
  std::vector<std::uint8_t> label(complex.cells());
  for (std::size_t c = 0; c < label.size(); ++c) {
    label[c] = random_unit(seed, 4, c) < share_empty ? 1 : 0;
  }
  return label;
}

}  // namespace roomcut::testing
