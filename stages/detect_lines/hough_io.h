// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "common/artefact/provenance.h"
#include "stages/detect_lines/detect_lines.h"

namespace roomcut::detect_lines {

/// Writes hough.h5 (schemas/hough.md): accumulator and classified cells, for pictures. Returns whether the
/// payload is new.
bool write_hough(const std::filesystem::path& path, const DetectLinesResult& result,
                 const Provenance& provenance);

}  // namespace roomcut::detect_lines
