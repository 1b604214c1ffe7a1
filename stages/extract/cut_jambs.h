// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "common/openings/opening.h"

namespace roomcut::extract {

/// Index of the line of this wall; none when the complex has no such line.
std::optional<std::int32_t> line_index(const CellComplex& complex, const std::string& wall_id);

/// The complex with the openings' jambs cut in, between the two faces of the wall and nowhere else; levels,
/// frame and the old lines as before, two more lines per opening. Openings whose jambs do not cross their
/// wall cut nothing. `parent`: per face, the one of the old complex that it is a part of.
CellComplex with_jambs(const CellComplex& complex, const std::vector<Opening>& openings,
                       std::vector<std::int32_t>& parent);

}  // namespace roomcut::extract
