// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/cells/level_surfaces.h"
#include "stages/extract/storeys.h"

namespace roomcut::extract {

/// The floor or the ceiling of a run: a plane over one plan face.
struct RunEnd {
  std::int32_t level;
  std::int32_t surface;  ///< index into LevelSurfaces::surfaces; -1 = it lies at its level
};

/// Where floors and ceilings are: at their surfaces, and without one at their levels. Keeps references.
class EndHeights {
 public:
  EndHeights(const CellComplex& complex, const LevelSurfaces& surfaces)
      : complex_(complex), surfaces_(surfaces) {}

  /// All at their levels.
  explicit EndHeights(const CellComplex& complex) : EndHeights(complex, kNone) {}

  RunEnd end(std::size_t face, std::size_t level) const {
    return {static_cast<std::int32_t>(level),
            surfaces_.of_face.empty() ? -1 : surfaces_.of_face[complex_.level_face(face, level)]};
  }
  double z(const RunEnd& end, const Vec2& p) const {
    return end.surface < 0 ? complex_.levels[static_cast<std::size_t>(end.level)] : surface(end).height(p);
  }
  bool is_sloped(const RunEnd& end) const { return end.surface >= 0 && !surface(end).gradient.isZero(0); }

  const CellComplex& complex() const { return complex_; }
  const LevelSurfaces& surfaces() const { return surfaces_; }

 private:
  static inline const LevelSurfaces kNone{};

  const LevelSurface& surface(const RunEnd& end) const {
    return surfaces_.surfaces[static_cast<std::size_t>(end.surface)];
  }

  const CellComplex& complex_;
  const LevelSurfaces& surfaces_;
};

/// The empty cells above each other over one plan face, without a gap.
struct Run {
  std::int32_t face;
  std::int16_t storey;
  RunEnd lower, upper;
};

/// All runs of a labelling, by plan face and height.
struct Columns {
  std::vector<Run> runs;
  std::vector<std::int64_t> offset;  ///< faces + 1: the runs of face f are [offset[f], offset[f + 1])

  std::size_t first(std::size_t face) const { return static_cast<std::size_t>(offset[face]); }
  std::size_t last(std::size_t face) const { return static_cast<std::size_t>(offset[face + 1]); }
};

/// A run has the storey of its lowest cell.
Columns columns_of(const EndHeights& heights, const std::vector<std::uint8_t>& label, const Storeys& storeys);

/// Heights at one plan vertex that are closer than this are one corner of the model [m]: planes meet levels
/// along lines that are kept to kPlanSnap_m, so that a slope misses the level by some times that. Never half
/// a layer or more.
double weld_distance(const CellComplex& complex);

/// What parts two runs above each other is left whatever their surfaces say: where a ceiling would come
/// through the floor over it, both go back to their levels. Returns the level faces that did, ascending.
std::vector<std::size_t> keep_slabs(const CellComplex& complex, LevelSurfaces& surfaces, Columns& columns);

/// Volume over one plan face between two planes, where the upper one is the upper one [m^3].
double volume_between(const EndHeights& heights, std::size_t face, const RunEnd& lower, const RunEnd& upper);

}  // namespace roomcut::extract
