// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/weigh_faces/coverage.h"
#include "stages/weigh_faces/divisions.h"
#include "stages/weigh_faces/sparse_counts.h"
#include "stages/weigh_faces/tolerances.h"

namespace roomcut {

/// The evidence on upright faces: for every line a raster (t along the line, z) of the points on it, and of
/// the points beside it on either side. The raster is divided at the ends of edges and at the levels, so that
/// every bin lies in one face. Filled by any number of threads; memory follows the touched surface.
class WallRasters {
 public:
  WallRasters(const CellComplex& complex, const Tolerances& tolerances);

  /// A point on the line.
  void add_on(std::int32_t line, double t, double z) { add(on_, line, t, z); }
  /// A point in the band beside the line, on no other parallel line; `plus` = on the side the line's normal
  /// points to.
  void add_beside(std::int32_t line, bool plus, double t, double z) {
    add(plus ? plus_ : minus_, line, t, z);
  }
  /// The same for a point on a level: floor or ceiling that reaches the wall.
  void add_level_beside(std::int32_t line, bool plus, double t, std::size_t level);

  /// Fills the wall_… members. Every line is worked on by one thread.
  void weigh(FaceWeights& weights) const;

 private:
  struct Raster {
    Divisions columns;                          // along the line, divided at the vertices on it
    std::size_t first_block = 0, blocks_t = 0;  // on_, plus_, minus_: blocks of 32 × 32 bins
    std::size_t first_column = 0;               // plus_level_, minus_level_: column * levels + level
  };
  /// Everything about one line that its faces are weighed with; columns × rows.
  struct Tables {
    AreaTable area, covered, points, plus, minus;
    std::vector<AreaTable> plus_level,
        minus_level;  // per level: columns that have floor or ceiling beside them
  };

  std::vector<Raster> lay_out();
  void add(SparseCounts& counts, std::int32_t line, double t, double z);
  std::size_t bin_index(const Raster& raster, int column, int row) const;
  Tables tables_of(const Raster& raster) const;
  AreaTable column_table(const SparseCounts& counts, const Raster& raster, std::size_t level) const;
  double omega_of(Divisions::Range columns, std::size_t layer, const Tables& tables) const;
  double plus_score(Divisions::Range columns, std::size_t layer, const Tables& tables,
                    const std::vector<double>& omega) const;
  void weigh_edge(std::size_t edge, const Raster& raster, const Tables& tables, FaceWeights& weights) const;

  const CellComplex& complex_;
  const Tolerances& tolerances_;
  Divisions rows_;                      // in z, divided at the levels
  std::size_t bins_ = 0, columns_ = 0;  // of all rasters; set while rasters_ is made
  std::vector<Raster> rasters_;
  SparseCounts on_, plus_, minus_, plus_level_, minus_level_;
};

}  // namespace roomcut
