// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/sloped_plane.h"
#include "common/slices/slices.h"
#include "stages/slice/plan_mask.h"
#include "stages/slice/surface_graph.h"

namespace roomcut::slice {

/// How levels are told apart; slice.h derives it from noise and density.
struct LevelRules {
  double noise_m = 0;
  double bandwidth_m = 0;       ///< Gaussian mean shift
  double raster_m = 0;          ///< of the cells
  double min_component_m2 = 0;  ///< upper bound: half of the largest surface is enough in a small room
  bool join_modes = true;       ///< modes that are nearly one become one
  bool connected = true;        ///< a level needs one connected surface of that size, else that much in all
  bool furniture = true;        ///< furniture is told apart
};

/// A mode of the density of horizontal area over height, with its basin: the range from which mean shift
/// leads to it.
struct HeightMode {
  double z = 0, lo = 0, hi = 0;  ///< [m]
  double drift_m = 0;            ///< of the surfaces in the basin, mean weighted by area
};

/// Modes of the density of horizontal area, ascending. Each cell is a Gaussian of its area, as wide as the
/// bandwidth or as 1.5 times the drift of its surface: one bandwidth would either tear drifting floors apart
/// or join ceilings that differ by a hand's breadth. With `join_modes`, modes nearer than max(2.5 cm, 4
/// noise) are one. Deterministic.
std::vector<HeightMode> height_modes(const std::vector<SurfaceCell>& cells, const LevelRules& rules);

/// Levels, ascending: the modes whose band, cut off where the density's gradient flattens, holds a connected
/// surface of min(rules.min_component_m2, half of the largest) that is no furniture. Paper §2, horizontal
/// slicing. `rejected` gets the others.
std::vector<Level> find_levels(const HeightSurvey& survey, const std::vector<SurfaceCell>& cells,
                               const LevelRules& rules, std::vector<Level>* rejected = nullptr);

/// The plan of all levels' surfaces.
PlanMask footprint(const std::vector<Level>& levels, const HeightSurvey& survey,
                   const std::vector<SurfaceCell>& cells);

/// Adds a level where walls or sloped surfaces over the building's own footprint go on farther than `reach_m`
/// beyond the lowest or highest level: the floor or ceiling there was not seen. Less than 1 m^2 or 2 % of all
/// upright area does not count, and the last 1 % of what goes on may stick out. Where planes go on, the level
/// lies 0.3 m beyond the last of them. A highest level of three or more on which walls of less than 1.5 m
/// stand, and no sloped ceiling, is a roof with its parapet, scanned from above: it is taken out.
void add_caps(std::vector<Level>& levels, const HeightSurvey& survey, const std::vector<SurfaceCell>& cells,
              const std::vector<SlopedPlane>& planes, double reach_m);

}  // namespace roomcut::slice
