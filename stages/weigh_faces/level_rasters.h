// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/weigh_faces/coverage.h"
#include "stages/weigh_faces/face_raster.h"
#include "stages/weigh_faces/sparse_counts.h"
#include "stages/weigh_faces/tolerances.h"

namespace roomcut {

/// The evidence on level faces: per level the points on it by piece of face, and per bin whether there are
/// points a hand above and below it. Filled by any number of threads; memory follows the touched surface.
class LevelRasters {
 public:
  LevelRasters(const CellComplex& complex, const Tolerances& tolerances);

  const FaceRaster& faces() const { return faces_; }
  void add_on(std::size_t level, std::size_t piece) { on_.add(level * faces_.pieces() + piece); }
  /// A point of a sloped surface: it covers the level like a ceiling (the underside of a roof).
  void add_sloped(std::size_t level, std::size_t piece) { sloped_.add(level * faces_.pieces() + piece); }
  /// A point that is on no level, in the band above (or below) this one.
  void add_over(std::size_t level, const Vec2& p) { add_bin(over_, level, p); }
  void add_under(std::size_t level, const Vec2& p) { add_bin(under_, level, p); }

  /// Fills the level_… members. Every level is worked on by one thread.
  void weigh(FaceWeights& weights) const;

 private:
  /// What the points beside a surface say of its empty side.
  struct Sides {
    double over = 0, under = 0;            // bins with points a hand above, below
    double open_over = 0, open_under = 0;  // bins with a tall gap on that side only
  };

  void add_bin(SparseCounts& counts, std::size_t level, const Vec2& p);
  std::vector<std::vector<std::uint8_t>> occupied_bins() const;
  void weigh_level(std::size_t level, const std::vector<std::vector<std::uint8_t>>& occupied,
                   FaceWeights& weights) const;
  std::vector<double> floor_probability(std::size_t level,
                                        const std::vector<std::vector<std::uint8_t>>& occupied) const;
  void add_gap(std::size_t level, std::size_t bin, const std::vector<std::vector<std::uint8_t>>& occupied,
               Sides& sides) const;

  const CellComplex& complex_;
  const Tolerances& tolerances_;
  FaceRaster faces_;
  SparseCounts on_, sloped_, over_, under_;
};

}  // namespace roomcut
