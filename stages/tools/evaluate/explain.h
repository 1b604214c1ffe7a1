// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/cells/level_surfaces.h"
#include "stages/tools/evaluate/spaces.h"
#include "stages/tools/evaluate/surface_scores.h"
#include "stages/tools/evaluate/thin_walls.h"
#include "stages/tools/evaluate/truth_rooms.h"

namespace roomcut::evaluate {

/// Why a place is wrong in the model.
enum class Cause : std::uint8_t {
  kLabels,           ///< the truth's own label on this cell would be right here
  kUnknown,          ///< the same, but the cell is labelled unknown (lost only)
  kOpenings,         ///< in no room of the truth: a doorway or shaft; or cut too wide (extra)
  kLinesMissing,     ///< a wall of the truth passes through the cell, no line near it
  kLinesMisplaced,   ///< the same, but a line bounds the cell within 10 cm of that wall
  kLevelsMissing,    ///< a floor or ceiling of the truth passes through the cell, no level near it
  kLevelsMisplaced,  ///< the same, but a level bounds the cell within 10 cm
  kSloped,           ///< the truth's nearest surface is neither upright nor level
  kOutside,          ///< beyond the complex's bounding box, levels or faces (lost only)
};
inline constexpr std::size_t kCauses = 9;
inline constexpr std::array<const char*, kCauses> kCauseNames = {
    "labels",         "unknown",          "openings", "lines_missing", "lines_misplaced",
    "levels_missing", "levels_misplaced", "sloped",   "outside"};

/// How well the cells could do, and what the labels made of them.
struct Explanation {
  double bound_iou = 0;   ///< of the truth's label (that of most of its volume) on every cell
  double labels_iou = 0;  ///< of the labels as they are
  double empty_m3 = 0;    ///< of all cells labelled empty, exactly
  /// Per cell, as sampled: its volume, and what of it is empty in the truth. Both 0 for a cell that no
  /// vertical line meets, or that is ignored: it has no label of the truth and counts nowhere.
  std::vector<double> cell_m3, cell_truth_m3;
  std::array<double, kCauses> lost_m3 = {};   ///< empty in the truth, solid in the model, by Cause
  std::array<double, kCauses> extra_m3 = {};  ///< solid in the truth, empty in the model
  /// What is known of a set of cells; shares and means are weighted by volume.
  struct Evidence {
    std::size_t cells = 0;
    double volume_m3 = 0, empty_m3 = 0;  ///< of the cells; of those labelled empty
    double evidence_m3 = 0;              ///< sum of D(solid) - D(empty): positive speaks for empty
    double beta = 0, observed = 0;
  };
  struct Room {
    double volume_m3 = 0;  ///< as sampled
    double own_m3 = 0;     ///< in cells that the truth's label calls empty; the rest no label can win
    Evidence own;          ///< of those cells among them that mostly belong to this room
  };
  std::vector<Room> rooms;  ///< parallel to the rooms of the truth
  /// A wall or slab between two found rooms of which more than half is missing: it merges them.
  struct LostWall {
    std::int32_t a, b;      ///< rooms
    double area_m2 = 0;     ///< missing
    double no_cell_m2 = 0;  ///< of that, where the truth's own label is empty: no cell for the wall
    bool slab = false;      ///< most of it lies level
    Evidence cells;         ///< of the cells in which the wall lies and which should be solid
    std::vector<std::string> wall_ids;  ///< lines along these cells that run with the wall, sorted
  };
  std::vector<LostWall> lost_walls;  ///< sorted by rooms
  /// A group of neighbouring cells labelled empty that are solid in the truth, and reach farther from its
  /// rooms than any wall or slab is thick: a garden, a balcony or a plenum that became a room.
  struct InventedSpace {
    Vec3 centre{0, 0, 0};
    double volume_m3 = 0;
  };
  std::vector<InventedSpace> invented;  ///< the largest first
  double invented_m3() const;
};

/// The final cells and what was made of them, moved() into the frame of the meshes.
struct LabelledCells {
  CellComplex complex;
  std::vector<std::uint8_t> label;  ///< per cell
  LevelSurfaces surfaces;           ///< the true floors and ceilings of these labels; may be empty
  std::optional<DataTerms> terms;
  std::string payload_sha256;  ///< of the artefact that holds the cells; empty when none does
};

/// What explain() compares. All in one frame.
struct ExplainInput {
  const CellComplex& complex;
  const std::vector<std::uint8_t>& label;  ///< per cell
  const LevelSurfaces& surfaces;           ///< where cells end in place of their levels; may be empty
  const DataTerms* terms;                  ///< may be null: the evidence is 0 then
  const Columns& truth;
  const Columns& model;  ///< of the cells labelled empty, openings cut
  const MeasuredSurface& truth_surface;
  const std::vector<TruthRoom>& rooms;
  const RoomFinder& finder;
  const std::vector<std::uint8_t>& found;  ///< per room
  const ThinWallScores& thin;
  const IgnoredSpace& ignored;
  double thin_wall_m;  ///< the thickest wall or slab
  Bounds3 box;         ///< of the truth
};

/// Compares cells and labels with the truth along one vertical line per square of `spacing_m`. Every wrong
/// place has one Cause; the lost and extra volumes add up to what volume_scores finds, up to sampling. Where
/// an opening was cut, the model counts and not the label of its cell. Parallel; the same result for any
/// number of threads.
Explanation explain(const ExplainInput& input, double spacing_m, std::uint64_t seed);

/// The complex, or the surfaces, moved by `by`.
CellComplex moved(CellComplex complex, const Vec3& by);
LevelSurfaces moved(LevelSurfaces surfaces, const Vec3& by);

}  // namespace roomcut::evaluate
