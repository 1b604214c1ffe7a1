// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/cells/level_finder.h"
#include "common/cloud/cloud.h"
#include "stages/weigh_faces/level_rasters.h"
#include "stages/weigh_faces/line_grid.h"
#include "stages/weigh_faces/slopes.h"
#include "stages/weigh_faces/wall_rasters.h"

namespace roomcut::weigh_faces {

/// Assigns each point to one wall line, one level, or the space beside them. Used by one thread at a time;
/// the counters that it fills are shared.
class PointSorter {
 public:
  PointSorter(const CellComplex& complex, const Tolerances& tolerances, const LevelFinder& heights,
              const Slopes& slopes, const LineGrid& lines, WallRasters& walls, LevelRasters& levels,
              SparseCounts& inside)
      : complex_(complex),
        heights_(heights),
        slopes_(slopes),
        tolerances_(tolerances),
        lines_(lines),
        walls_(walls),
        levels_(levels),
        inside_(inside) {}

  void add(const Vec3& p, SurfaceClass surface, std::uint8_t azimuth);

 private:
  struct Candidate {
    std::int32_t line;
    double e;  // signed distance of the point
  };
  struct NearLevel {
    std::size_t level;
    double dz;     // point above level
    double reach;  // half the gap to the next level on the point's side
  };

  NearLevel nearest_level(double z) const;
  std::int32_t wall_of(SurfaceClass surface, std::uint8_t azimuth) const;
  void add_beside_walls(const Vec2& p, std::size_t level);
  void add_on_plane(const Vec2& p, const Slopes::Found& on);
  void add_sloped(std::size_t piece, const NearLevel& near, std::size_t layer, double z);
  void add_beside_levels(const Vec2& p, double z);
  void add_inside(const Vec2& p, double z, const NearLevel& near);
  std::int32_t wall_of_unclassed() const;
  std::int32_t wall_at_foot() const;
  bool parallel(std::int32_t a, std::int32_t b) const;
  const PlanLine& line(std::int32_t index) const { return lines_.line(index); }

  const CellComplex& complex_;
  const LevelFinder& heights_;
  const Slopes& slopes_;
  const Tolerances& tolerances_;
  const LineGrid& lines_;
  WallRasters& walls_;
  LevelRasters& levels_;
  SparseCounts& inside_;
  std::vector<Candidate> candidates_;
};

}  // namespace roomcut::weigh_faces
