// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/wall_lines/wall_line.h"

namespace roomcut::extract {

/// Faces of the model that are one curved surface: a part of an upright cylinder.
struct CurvedWall {
  std::string id;  ///< of the arc, in wall_lines.geojson
  Vec2 centre{0, 0};
  double radius_m = 0;
  double from = 0, to = 0;            ///< azimuths from the centre, counter-clockwise, to > from [rad]
  double z0 = 0, z1 = 0;              ///< of its levels [m]
  double area_m2 = 0;                 ///< between empty and other cells, at the levels
  std::vector<int> storeys;           ///< ascending
  std::vector<std::string> wall_ids;  ///< of its chords on which the model has a surface, ascending
};

/// The curved walls on whose chords the model has a surface of 0.2 m^2 at least, by id. `lines` are those
/// that the complex was cut with; `storey` per cell.
std::vector<CurvedWall> find_curved_walls(const WallLines& lines, const CellComplex& complex,
                                          const std::vector<std::uint8_t>& label,
                                          const std::vector<std::int16_t>& storey);

}  // namespace roomcut::extract
