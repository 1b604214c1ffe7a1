// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/wall_lines/wall_line.h"

namespace roomcut::refine_lines {

/// A stretch of a wall line that was plainly seen from one side although both sides are empty in the first
/// cut: a wall whose other face was not seen (a room not entered, furniture all along it), so that no line
/// closes it.
struct OneSidedWall {
  std::string wall_id;
  bool back_is_plus = false;         ///< the back looks to where the line's normal points
  double t0 = 0, t1 = 0;             ///< along `line` [m]
  std::vector<std::int32_t> layers;  ///< ascending
  double area_m2 = 0;                ///< seen
  Line2 line;                        ///< of the first cut; the refined one may look the other way
};

/// All one-sided walls of at least `least_m2`, by line, then side. `label` as in Labels.
std::vector<OneSidedWall> find_one_sided(const CellComplex& complex, const FaceWeights& weights,
                                         const std::vector<std::uint8_t>& label, double least_m2);

/// Their lines, which refinement must not drop.
std::set<std::string> ids_of(const std::vector<OneSidedWall>& walls);

/// The usual distance between the two faces of a wall in the first cut, weighted by area: its median; 0.15 m
/// when there is none.
double usual_thickness(const CellComplex& complex, const std::vector<std::uint8_t>& label);

/// Adds for each one-sided wall whose line is still there the face that was not seen: parallel, `thickness_m`
/// behind, in its layers only, with a note that says so and no sigma. None where another line already runs 5
/// … 60 cm behind in all those layers. Returns how many were added; `lines` stays sorted by id.
int add_unseen_faces(const std::vector<OneSidedWall>& walls, double thickness_m, WallLines& lines);

}  // namespace roomcut::refine_lines
