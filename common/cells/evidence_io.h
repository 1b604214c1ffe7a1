// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/artefact/h5_values.h"
#include "common/cells/cells_io.h"

namespace roomcut {

/// Attribute of weights, data_terms and labels: the payload digest of the cells.h5 that their indices refer
/// to.
inline constexpr const char* kCellsDigest = "cells_payload_sha256";

/// Opens a file that belongs to `cells`; kArtefactMismatch when it was made for other cells.
H5Reader open_for_cells(const std::filesystem::path& path, ArtefactType type, const CellsFile& cells);

/// Checks, before writing, that a dataset has one value per element; a stage that gets this wrong has a bug.
void require_size(std::size_t actual, std::size_t expected, const char* dataset);

}  // namespace roomcut
