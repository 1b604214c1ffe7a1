// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "common/artefact/provenance.h"
#include "common/slices/slices.h"

namespace roomcut {

/// Reads slices.h5. Errors: kArtefact… (common/artefact/h5.h). With `grids` false the occupancy grids stay
/// empty.
Slices read_slices(const std::filesystem::path& path, bool grids = true);
/// Returns whether the payload is new.
bool write_slices(const std::filesystem::path& path, const Slices& slices, const Provenance& provenance);

}  // namespace roomcut
