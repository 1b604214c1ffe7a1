// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "stages/tools/evaluate/scanned_surface.h"
#include "stages/tools/evaluate/surface_scores.h"
#include "stages/tools/evaluate/truth_rooms.h"

namespace roomcut::evaluate {

/// Thin structure of the truth and what the model made of it. A *thin place* is a place on the truth's
/// surface behind which, straight through the wall or slab, another surface follows within `thickest_m` that
/// looks away (the other face of the same wall). It is kept when the model is solid midway between the two
/// faces. A doorway that the model states as an opening of a wall joins no rooms.
struct ThinWallScores {
  double wall_m2 = 0, wall_kept_m2 = 0;  ///< of walls; both faces count
  double slab_m2 = 0, slab_kept_m2 = 0;  ///< of slabs
  /// Pairs of rooms with at least 0.5 m^2 of thin places between them.
  struct Pair {
    std::int32_t a, b;  ///< rooms, a < b
    double area_m2 = 0, missing_m2 = 0;
  };
  std::vector<Pair> pairs;  ///< sorted by (a, b)
  /// A thin place between two rooms where the model is empty.
  struct LostPlace {
    std::int32_t a, b;  ///< rooms, a < b
    Vec3 middle, normal;
    double area_m2;
    bool wall;  ///< upright, else a slab
  };
  std::vector<LostPlace> lost;

  /// Whether more than half of what stands between the two rooms is missing.
  static bool is_lost(const Pair& pair) { return pair.missing_m2 > 0.5 * pair.area_m2; }
};

/// `in_opening`: whether a place where the model is empty lies in an opening that was cut into a wall of the
/// model. `scanned`: with it, thin places beside a room that was scanned, which no scanned surface surrounds
/// on either face, stand between no rooms: a doorway up to the ceiling, of which the rooms of the truth know
/// nothing.
ThinWallScores score_thin_walls(const SurfaceDistances& truth_samples, const MeshTree& truth_tree,
                                const RoomFinder& finder, const Columns& model, double thickest_m,
                                const std::function<bool(const Vec3&)>& in_opening,
                                const ScannedSurface* scanned);

/// Groups of rooms that the model has joined: more than half of the wall or slab between two of them is
/// missing, and both are found. Each group sorted, at least two rooms; sorted by first room.
std::vector<std::vector<std::int32_t>> merged_rooms(const ThinWallScores& thin,
                                                    const std::vector<std::uint8_t>& found);

}  // namespace roomcut::evaluate
