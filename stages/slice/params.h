// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/params/params.h"

namespace roomcut::slice {

/// Parameters of `slice`; an empty optional is derived from noise and density (slice.h: SliceChoices says
/// what and why).
struct SliceParams {
  std::optional<double> bandwidth_m;       ///< of the mean shift over heights [m]
  std::optional<double> raster_m;          ///< edge of the plan raster in which surfaces are connected [m]
  std::optional<double> min_component_m2;  ///< smallest connected surface that makes a level [m^2]
  std::optional<double> tau_m;             ///< edge of the occupancy cells [m]
  bool by_area = true;           ///< horizontal points weigh the area for which they stand, else all the same
  bool drift = true;             ///< drifting surfaces get a wider bandwidth
  bool join_modes = true;        ///< modes that are nearly one become one level
  bool connected = true;         ///< min_component_m2 must be one connected surface, else the sum of the band
  bool furniture = true;         ///< surfaces of furniture are told apart and are no levels
  bool upright_only = true;      ///< horizontal and sloped points do not count in wall slices
  bool open_edges = true;        ///< where ceilings end in the open counts as wall
  double cap_reach_m = 0.2;      ///< walls that go on farther past the last level get a cap [m]
  double step_m = 0.3;           ///< distance of the levels that stand for a slope; 0 = none [m]
  double tall_slice_m = 1.5;     ///< higher wall slices count evidence in their top part only [m]
  double evidence_share = 0.25;  ///< that top part, as a share of the slice's height
};

/// The block `slice` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(SliceParams& p) {
  return {
      auto_number("bandwidth_m", p.bandwidth_m, "m", 0.002, 0.5,
                  "Bandwidth of the mean shift that finds the peaks of the height histogram.",
                  "max(7 mm, 1.5 x noise)"),
      auto_number("raster_m", p.raster_m, "m", 0.02, 1.0,
                  "Edge of the plan raster in which horizontal surfaces are connected.",
                  "2.5 x point spacing (a preferred number), 10 ... 40 cm"),
      auto_number("min_component_m2", p.min_component_m2, "m^2", 0.1, 100.0,
                  "Smallest connected horizontal surface that makes a level.",
                  "4 m^2; half of the largest surface if that is less"),
      auto_number("tau_m", p.tau_m, "m", 0.01, 0.5,
                  "Edge of the occupancy cells of a wall slice (the paper's tau).",
                  "3 points per cell, 2 x noise (a preferred number), 4 ... 10 cm"),
      boolean("by_area", p.by_area,
              "Horizontal points weigh the area for which they stand; false: all the same."),
      boolean("drift", p.drift, "Surfaces that drift up and down get a wider bandwidth."),
      boolean("join_modes", p.join_modes, "Peaks that are nearly one become one level."),
      boolean("connected", p.connected,
              "A level needs min_component_m2 in one piece; false: in all, wherever it lies."),
      boolean("furniture", p.furniture, "Tables and beds are told from floors, and are no levels."),
      boolean("upright_only", p.upright_only,
              "Only points of walls and points without a plane count in wall slices; false: all points."),
      boolean("open_edges", p.open_edges,
              "Where a ceiling ends straight and the floor goes on under the open sky, as at glass, counts "
              "as wall."),
      number("cap_reach_m", p.cap_reach_m, "m", 0.05, 1000.0,
             "Walls that go on farther past the last level get a cap there."),
      number("step_m", p.step_m, "m", 0.0, 5.0,
             "Distance of the levels that stand for a sloped roof or ramp; 0 = none."),
      number("tall_slice_m", p.tall_slice_m, "m", 0.0, 100.0,
             "Wall slices higher than this count evidence in their top part only."),
      number("evidence_share", p.evidence_share, "1", 0.05, 1.0,
             "That top part, as a share of the slice's height."),
  };
}

}  // namespace roomcut::slice
