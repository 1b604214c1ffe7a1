// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/artefact/h5_blocks.h"
#include "common/artefact/h5_values.h"
#include "common/cloud/cloud.h"

namespace roomcut {

/// All of a cloud.h5 but its points: every number in a sane range, tiles in order and in the scan's box, one
/// value per point in every column. Errors: kArtefactDamaged.
CloudHeader read_cloud_header(const H5Reader& file);

/// The checksums of the blocks of points, which begin and end with tiles; none in a cloud of version 1.0,
/// whose payload digest covers the points themselves. Errors: kArtefactDamaged.
std::optional<h5::BlockTable> read_cloud_blocks(const H5Reader& file, const CloudHeader& header);

}  // namespace roomcut
