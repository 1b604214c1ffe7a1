// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/weigh_faces/coverage.h"
#include "stages/weigh_faces/divisions.h"
#include "stages/weigh_faces/sparse_counts.h"
#include "stages/weigh_faces/tolerances.h"

namespace roomcut::weigh_faces {

/// The evidence on upright faces: for every line a raster (t along the line, z) of the points on it, and per
/// column of it whether floor or ceiling reaches it from either side. The raster is divided at the ends of
/// edges and at the levels, so that every bin lies in one face. Filled by any number of threads; memory
/// follows the touched surface.
class WallRasters {
 public:
  WallRasters(const CellComplex& complex, const Tolerances& tolerances);

  /// A point on the line.
  void add_on(std::int32_t line, double t, double z);
  /// A point of a level in the band beside the line, with no other parallel line at it or between; `plus` =
  /// on the side that the line's normal points to.
  void add_level_beside(std::int32_t line, bool plus, double t, std::size_t level);

  /// Fills wall_omega and wall_points. One thread per line.
  void weigh_coverage(FaceWeights& weights) const;
  /// Fills wall_left and wall_right from the coverage of walls and levels.
  void weigh_sides(FaceWeights& weights) const;

 private:
  struct Raster {
    Divisions columns;                          // along the line, divided at the vertices on it
    std::size_t first_block = 0, blocks_t = 0;  // on_: blocks of 32 × 32 bins
    std::size_t first_column = 0;               // plus_, minus_: column * levels + level
    std::vector<std::size_t> edges;             // of the line
  };
  struct Tables {
    AreaTable area, covered, points;  // columns × rows
  };

  std::vector<Raster> lay_out();
  std::size_t bin_index(const Raster& raster, int column, int row) const;
  Tables tables_of(const Raster& raster) const;
  Divisions::Range columns_of(std::size_t edge, const Raster& raster) const;
  Divisions::Range rows_of(std::size_t layer) const;
  double omega_of(const Raster& raster, Divisions::Range columns, std::size_t layer,
                  const Tables& tables) const;
  bool is_beam(const Raster& raster, Divisions::Range columns, std::size_t layer, const Tables& tables) const;
  bool floor_on_both_sides(const Raster& raster, int column, std::size_t layer) const;
  static double occupied_columns(Divisions::Range columns, Divisions::Range rows, const Tables& tables);
  double strip(const SparseCounts& counts, const Raster& raster, Divisions::Range columns,
               std::size_t level) const;

  const CellComplex& complex_;
  const Tolerances& tolerances_;
  Divisions rows_;                      // in z, divided at the levels
  std::size_t bins_ = 0, columns_ = 0;  // of all rasters; set while rasters_ is made
  std::vector<Raster> rasters_;
  SparseCounts on_, plus_, minus_;
};

}  // namespace roomcut::weigh_faces
