// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/artefact/h5.h"
#include "common/cells/cells_io.h"

namespace roomcut {

/// Attribute of weights, data_terms and labels: the payload digest of the cells.h5 that their indices refer
/// to.
inline constexpr const char* kCellsDigest = "cells_payload_sha256";

/// Opens a file that belongs to `cells`; kArtefactMismatch when it was made for other cells.
H5Reader open_for_cells(const std::filesystem::path& path, ArtefactType type, const CellsFile& cells);

/// Checks that all values lie in [low, high] (NaN never does); kArtefactDamaged otherwise.
template <class T>
void check_range(const H5Reader& file, const char* path, const std::vector<T>& values, double low,
                 double high) {
  for (const T value : values) {
    if (!(static_cast<double>(value) >= low && static_cast<double>(value) <= high)) {
      file.damaged(path, "a value is not finite or out of range");
    }
  }
}

/// Checks, before writing, that a dataset has one value per element; a stage that gets this wrong has a bug.
void require_size(std::size_t actual, std::size_t expected, const char* dataset);

}  // namespace roomcut
