// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/slice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "common/errors/codes.h"
#include "common/geometry/preferred_number.h"
#include "stages/slice/levels.h"
#include "stages/slice/open_edges.h"
#include "stages/slice/planes.h"
#include "stages/slice/steps.h"
#include "stages/slice/surfaces.h"
#include "stages/slice/survey.h"
#include "stages/slice/wall_slices.h"

namespace roomcut::slice {
namespace {

constexpr double kHistogramBin = 0.005;  // m; below any useful bandwidth

/// Takes the user's value, or the derived one and notes it.
double resolve(const std::optional<double>& given, double derived, const char* name,
               std::vector<SliceChoice>& choices) {
  if (given) return *given;
  choices.push_back({name, derived});
  return derived;
}

LevelRules level_rules(const CloudHeader& header, const SliceParams& params,
                       std::vector<SliceChoice>& choices) {
  const double spacing = header.density > 0 ? 1 / std::sqrt(header.density) : 0.1;
  LevelRules rules;
  rules.noise_m = header.noise_m;
  rules.bandwidth_m =
      resolve(params.bandwidth_m, std::max(0.007, 1.5 * header.noise_m), "bandwidth_m", choices);
  rules.raster_m =
      resolve(params.raster_m, std::clamp(preferred_number(2.5 * spacing), 0.10, 0.40), "raster_m", choices);
  rules.min_component_m2 = resolve(params.min_component_m2, 4.0, "min_component_m2", choices);
  rules.join_modes = params.join_modes;
  rules.connected = params.connected;
  rules.furniture = params.furniture;
  return rules;
}

double choose_tau(const CloudHeader& header, const SliceParams& params, std::vector<SliceChoice>& choices) {
  // About three points per cell of a room's evidence height (0.6 m), and cells wider than twice the noise.
  const double sparse = header.density > 0 ? 3 / (0.6 * header.density) : 0.1;
  const double tau = std::clamp(preferred_number(std::max(sparse, 2 * header.noise_m)), 0.04, 0.10);
  return resolve(params.tau_m, tau, "tau_m", choices);
}

std::string format(const char* text, double a, double b, double c) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, text, a, b, c);
  return buffer;
}

double horizontal_m2(const HeightSurvey& survey) {
  return std::accumulate(survey.horizontal.area_m2.begin(), survey.horizontal.area_m2.end(), 0.0);
}

double upright_m2(const HeightSurvey& survey) {
  return std::accumulate(survey.upright.begin(), survey.upright.end(), 0.0,
                         [](double sum, const UprightBlock& block) { return sum + block.area_m2; });
}

[[noreturn]] void no_levels(const HeightSurvey& survey, const std::vector<Level>& rejected) {
  Level best;
  for (const Level& level : rejected) {
    if (level.component_m2 > best.component_m2) best = level;
  }
  throw StageError(
      errors::kNoLevels, "slice",
      format(
          "no floor or ceiling: %.2f m^2 of horizontal surface in all, the largest connected piece %.2f m^2 "
          "at %.2f m",
          horizontal_m2(survey), best.component_m2, best.z),
      "is z really up (ingest --up) and the unit right (ingest --unit)?");
}

void require_levels(const HeightSurvey& survey, const std::vector<Level>& levels,
                    const std::vector<Level>& rejected) {
  if (levels.empty()) no_levels(survey, rejected);
  if (levels.size() == 1) {
    throw StageError(
        errors::kNoLevels, "slice",
        format("only one level, at %.2f m with %.2f m^2, and no wall goes on past it (%.2f m^2 of upright "
               "surface in all)",
               levels[0].z, levels[0].area_m2, upright_m2(survey)),
        "a model needs a floor and a ceiling, or walls beside a floor");
  }
}

void require_vertical(const HeightSurvey& survey, const std::vector<OccupancyGrid>& grids) {
  const bool any =
      std::any_of(grids.begin(), grids.end(), [](const OccupancyGrid& grid) { return grid.size() > 0; });
  if (any) return;
  throw StageError(
      errors::kNoVertical, "slice",
      format("no wall: %.2f m^2 of upright surface against %.2f m^2 of horizontal surface, none of it "
             "between the levels",
             upright_m2(survey), horizontal_m2(survey), 0),
      "is z really up (ingest --up)?");
}

}  // namespace

SliceResult slice_cloud(const CloudHeader& header, const TileSource& tiles, const SliceParams& params) {
  SliceResult result;
  const LevelRules rules = level_rules(header, params, result.choices);
  Slices& slices = result.slices;
  HeightSurvey survey = survey_heights(header, tiles, rules.raster_m, kHistogramBin, params.by_area);
  std::vector<SurfaceCell> cells = surface_cells(survey.patches, rules.noise_m);
  std::vector<SurfaceCell> with_planes;  // where nothing slopes they are the same
  const SlopedSurfaces sloped = params.step_m > 0 ? find_planes(survey, rules.noise_m) : SlopedSurfaces{};
  slices.planes = sloped.planes;
  if (!slices.planes.empty()) {
    with_planes = std::move(cells);
    remove_planes(sloped, rules.noise_m, survey);
    cells = surface_cells(survey.patches, rules.noise_m);
  }
  std::vector<SurfaceVoxel>().swap(survey.voxels);
  if (params.drift) measure_drift(cells, rules.raster_m, rules.noise_m);
  slices.frame = header.frame;
  slices.bbox_min = header.bbox_min;
  slices.bbox_max = header.bbox_max;
  slices.noise_m = header.noise_m;
  slices.density = header.density;
  slices.step_m = params.step_m;
  slices.histogram = survey.horizontal;
  slices.levels = find_levels(survey, cells, rules, &result.rejected);
  add_caps(slices.levels, survey, cells, slices.planes, params.cap_reach_m);
  require_levels(survey, slices.levels, result.rejected);
  if (params.step_m > 0) add_steps(slices.levels, survey, cells, slices.planes, params.step_m);

  slices.tau_m = choose_tau(header, params, result.choices);
  const auto ranges = evidence_ranges(slices.levels, params.tall_slice_m, params.evidence_share,
                                      slices.planes, 0.5 * slices.tau_m);
  slices.wall_slices = occupy_wall_slices(tiles, ranges, slices.tau_m, params.upright_only);
  if (params.open_edges) {
    result.open_edges = open_edges(survey, with_planes.empty() ? cells : with_planes, slices.levels);
    for (const OpenEdge& edge : result.open_edges) {
      add_open_edge(edge, slices.tau_m, slices.wall_slices[edge.level - 1]);
    }
  }
  require_vertical(survey, slices.wall_slices);
  return result;
}

}  // namespace roomcut::slice
