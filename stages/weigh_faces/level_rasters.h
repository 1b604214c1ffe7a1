// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/cells/face_raster.h"
#include "stages/weigh_faces/coverage.h"
#include "stages/weigh_faces/level_sides.h"
#include "stages/weigh_faces/sparse_counts.h"
#include "stages/weigh_faces/tolerances.h"

namespace roomcut::weigh_faces {

/// The evidence on level faces: per level the points on it by piece of face, and per bin whether there are
/// points a hand above and below it. Filled by any number of threads; memory follows the touched surface.
class LevelRasters {
 public:
  LevelRasters(const CellComplex& complex, const Tolerances& tolerances);

  const FaceRaster& faces() const { return faces_; }
  void add_on(std::size_t level, std::size_t piece) { on_.add(level * faces_.pieces() + piece); }
  /// A point of a sloped surface: it covers the level like a ceiling (the underside of a roof).
  void add_sloped(std::size_t level, std::size_t piece) { sloped_.add(level * faces_.pieces() + piece); }
  /// A point of a sloped surface inside a layer.
  void add_slope(std::size_t layer, std::size_t piece) { slope_.add(layer * faces_.pieces() + piece); }
  /// A point that is on no level, in the band above (or below) this one.
  void add_over(std::size_t level, const Vec2& p) { add_bin(over_, level, p); }
  void add_under(std::size_t level, const Vec2& p) { add_bin(under_, level, p); }

  /// Fills the level_… members and cell_slope; wall_omega must be there already. Every level is worked on by
  /// one thread.
  void weigh(FaceWeights& weights) const;

 private:
  using Occupied =
      std::vector<std::vector<std::uint8_t>>;  // per level and bin: whether there are points on it

  /// What all levels have in common: the plan.
  struct Plan {
    std::vector<std::uint32_t> bin_of_piece;
    std::vector<float> bin_area;  ///< of the faces in a bin, without their margins [m²]
    AreaTable area_table;         ///< of bin_area
    std::vector<double> face_area;
  };

  void add_bin(SparseCounts& counts, std::size_t level, const Vec2& p);
  Plan measure_plan() const;
  Occupied occupied_bins(const Plan& plan) const;
  /// The share of every face that is covered by the counters [base, base + pieces) of `counts`, or those of
  /// `more` beside them.
  std::vector<float> covered_share(const Plan& plan, std::size_t base, const SparseCounts& counts,
                                   const SparseCounts* more) const;
  void weigh_level(const Plan& plan, std::size_t level, const Occupied& occupied, FaceWeights& weights) const;
  void weigh_slopes(const Plan& plan, std::size_t layer, FaceWeights& weights) const;
  std::vector<LevelSides> sides_of_faces(std::size_t level, const Occupied& occupied) const;
  void add_gap(std::size_t level, std::size_t bin, const Occupied& occupied, LevelSides& sides) const;

  const CellComplex& complex_;
  const Tolerances& tolerances_;
  FaceRaster faces_;
  SparseCounts on_, sloped_, slope_, over_, under_;
};

}  // namespace roomcut::weigh_faces
