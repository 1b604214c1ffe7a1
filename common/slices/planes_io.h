// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/artefact/h5.h"
#include "common/geometry/sloped_plane.h"

namespace roomcut {

/// Writes the group `planes` of slices.h5 and cells.h5.
void write_planes(H5Writer& file, const std::vector<SlopedPlane>& planes);

/// Reads it; none when the file, of an older version, has no such group. Throws kArtefactDamaged for values
/// out of range, offsets that do not fit and outlines that are not convex and counter-clockwise.
std::vector<SlopedPlane> read_planes(const H5Reader& file);

}  // namespace roomcut
