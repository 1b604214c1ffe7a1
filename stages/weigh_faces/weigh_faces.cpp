// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/weigh_faces.h"

#include <algorithm>

#include "stages/weigh_faces/continued_walls.h"
#include "stages/weigh_faces/level_rasters.h"
#include "stages/weigh_faces/line_grid.h"
#include "stages/weigh_faces/point_sorter.h"
#include "stages/weigh_faces/seen_through.h"
#include "stages/weigh_faces/slopes.h"
#include "stages/weigh_faces/wall_rasters.h"

namespace roomcut::weigh_faces {

namespace {

constexpr double kRim_m = 0.3;  // from the outermost points of a sloped plane to the walls around it

}  // namespace

struct FaceWeigher::State {
  State(const CellComplex& c, const CloudHeader& cloud, const WeighFacesParams& p)
      : complex(c),
        params(p),
        tolerances(resolve_tolerances(p, cloud)),
        heights(c.levels),
        slopes(c, tolerances.level_reach, kRim_m),
        lines(c, std::max(tolerances.wall_alone, tolerances.beside_high), tolerances.azimuth),
        walls(c, tolerances),
        levels(c, tolerances),
        inside(c.cells()) {}

  const CellComplex& complex;
  WeighFacesParams params;
  Tolerances tolerances;
  LevelFinder heights;
  Slopes slopes;
  LineGrid lines;
  WallRasters walls;
  LevelRasters levels;
  SparseCounts inside;
};

namespace {

/// Both sides of every face alike.
void forget_sides(FaceWeights& weights) {
  const auto halve = [](const std::vector<float>& omega, std::vector<float>& a, std::vector<float>& b) {
    std::transform(omega.begin(), omega.end(), a.begin(), [](float w) { return 0.5F * w; });
    b = a;
  };
  halve(weights.wall_omega, weights.wall_left, weights.wall_right);
  halve(weights.level_omega, weights.level_floor, weights.level_ceiling);
}

}  // namespace

FaceWeigher::FaceWeigher(const CellComplex& complex, const CloudHeader& cloud, const WeighFacesParams& params)
    : state_(std::make_unique<State>(complex, cloud, params)) {}
FaceWeigher::~FaceWeigher() = default;

const Tolerances& FaceWeigher::tolerances() const {
  return state_->tolerances;
}

void FaceWeigher::add(const CloudTile& tile) {
  PointSorter sorter(state_->complex, state_->tolerances, state_->heights, state_->slopes, state_->lines,
                     state_->walls, state_->levels, state_->inside);
  for (std::size_t i = 0; i < tile.size(); ++i) {
    sorter.add({tile.x[i], tile.y[i], tile.z[i]}, static_cast<SurfaceClass>(tile.surface[i]),
               tile.azimuth[i]);
  }
}

FaceWeights FaceWeigher::weigh() const {
  FaceWeights weights;
  state_->walls.weigh_coverage(weights);
  state_->levels.weigh(weights);
  state_->walls.weigh_sides(weights);
  if (!state_->params.sides) forget_sides(weights);
  if (state_->params.seen_through) discount_seen_through(state_->complex, weights);
  if (state_->params.continue_walls) continue_walls(state_->complex, weights);
  cover_risers(state_->complex, weights);
  weights.cell_points.resize(state_->complex.cells());
  for (std::size_t c = 0; c < weights.cell_points.size(); ++c) {
    weights.cell_points[c] = state_->inside.at(c);
  }
  return weights;
}

}  // namespace roomcut::weigh_faces
