// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "common/cells/cells_io.h"
#include "common/cells/level_surfaces.h"

namespace roomcut {

/// Reads surfaces.h5 (page schemas/surfaces.md). Errors: kArtefact… (common/artefact/h5.h), kArtefactMismatch
/// when it was made for other cells. What it gives: every index points at something, every number is finite
/// and of a size that a building has.
LevelSurfaces read_surfaces(const std::filesystem::path& path, const CellsFile& cells);

/// Writes it; whether the payload is new. std::logic_error unless there is one entry per level face.
bool write_surfaces(const std::filesystem::path& path, const LevelSurfaces& surfaces, const CellsFile& cells,
                    const Provenance& provenance);

}  // namespace roomcut
