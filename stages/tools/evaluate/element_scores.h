// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "stages/tools/evaluate/surface_scores.h"
#include "stages/tools/evaluate/truth_rooms.h"

namespace roomcut::evaluate {

/// A column of the truth: solid over a polygon.
struct DescribedColumn {
  std::vector<Vec2> polygon;
  double z0 = 0, z1 = 0;
  double size_m = 0;  ///< the smaller side, or the diameter
};

/// A niche of the truth, or a pilaster: what lies over a polygon from the wall's plane on.
struct DescribedNiche {
  std::vector<Vec2> polygon;
  double z0 = 0, z1 = 0;
  double width_m = 0, depth_m = 0;
  bool solid = false;  ///< a pilaster
};

/// How closely the model follows what of the truth is neither level nor upright: between 0.3 and 80 degrees.
struct SlopeScores {
  double area_m2 = 0;
  std::optional<double> angle_median_deg, angle_p95_deg;  ///< to the nearest surface of the model, by area
  std::optional<double> matched;                          ///< share of the area within 1 degree and 2 cm
};

struct ColumnScores {
  struct Column {
    double size_m = 0;
    double solid = 0;  ///< share of its volume that is solid in the model
    bool found() const { return solid > 0.5; }
  };
  std::vector<Column> columns;
  std::size_t false_pillars = 0;  ///< of the model, under 1 m^2, free of the truth's walls and columns
  double floor_m2 = 0;            ///< of the rooms, on which they could stand
  std::size_t found() const;
};

struct NicheScores {
  struct Niche {
    double width_m = 0, depth_m = 0;
    bool solid = false;
    double area_m2 = 0, near_m2 = 0;  ///< of its faces; within 2 cm of a face of the model that faces so
  };
  std::vector<Niche> niches;
  double area_m2() const;
  double near_m2() const;
};

/// How far the model's floor and ceiling of a room are above the truth's [m]: medians over the room's plan;
/// empty where the model has none within 30 cm.
struct RoomHeights {
  std::optional<double> floor_off_m, ceiling_off_m;
};

/// `truth` are the truth's samples, `truth_surface` what they were taken of. Parallel.
SlopeScores score_slopes(const SurfaceDistances& truth, const MeasuredSurface& truth_surface,
                         const MeasuredSurface& model_surface);

NicheScores score_niches(const std::vector<DescribedNiche>& niches, const SurfaceDistances& truth,
                         const MeasuredSurface& truth_surface, const MeasuredSurface& model_surface);

/// Pillars are looked for in rooms with a polygon, on a raster of 5 cm: where the model is solid over nine
/// tenths of the height between the truth's floor and ceiling.
ColumnScores score_columns(const std::vector<DescribedColumn>& columns, const std::vector<TruthRoom>& rooms,
                           const Columns& truth, const Columns& model);

/// Of rooms with a polygon, along vertical lines every 20 cm.
RoomHeights score_heights(const TruthRoom& room, const Columns& truth, const Columns& model);

}  // namespace roomcut::evaluate
