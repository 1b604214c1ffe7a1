// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stages/ingest/text_dialect.h"

namespace roomcut::ingest {

/// What a column of a text table is: 0 … 5 for x, y, z, nx, ny, nz, or kNoRole.
inline constexpr int kNoRole = -1;

/// The columns that a line of names gives.
struct NamedColumns {
  std::vector<int> roles;  ///< one per name; kNoRole for all unless found()
  std::string unclear;     ///< why not, when some of x, y, z are named, but not each once
  bool found() const;      ///< x, y and z are named, each once
  bool known = false;      ///< at least one name is one of a coordinate
};

/// Finds x, y, z and normals by their usual names: x, pos_x, coord x, X [m] …; easting, east, E, Rechtswert
/// …; northing, Hochwert …; z, height, elevation, H, Höhe …. Case, blanks, punctuation and units do not
/// matter. Two sets of coordinates (x, y and easting, northing) are unclear.
NamedColumns columns_of_names(const Fields& names);

/// A name without case, blanks, punctuation and unit: "pos_x [m]" gives "posx"; empty for a unit alone.
std::string bare_name(std::string_view name);

/// Whether all names are units: a second header line, "[m],[m],[m]".
bool only_units(const Fields& names);

}  // namespace roomcut::ingest
