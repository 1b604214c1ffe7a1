// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/artefact/provenance.h"
#include "common/wall_lines/wall_line.h"

namespace roomcut {

/// A wall_lines.geojson with what the file says of itself.
struct WallLinesFile {
  WallLines content;
  Provenance provenance;       ///< empty stage when the file has none (drawn by hand)
  std::string payload_sha256;  ///< digest of the canonical content without provenance
  std::vector<std::string> warnings;
};

/// Reads a file written by a stage. Strict: any problem is an error (kArtefact… codes).
WallLinesFile read_wall_lines(const std::filesystem::path& path);

/// Reads a file that a person or another program may have written (rules: schemas/wall_lines.md): tolerant
/// where the meaning is clear, with warnings; otherwise StageError with ALL problems of the file. `base`
/// supplies frame, bounding box and, by wall_id, the properties that an editor dropped; lines that differ
/// from it become `edited` or `added`.
WallLinesFile read_edited_wall_lines(const std::filesystem::path& path, const WallLines& base);

/// Digest of lines, frame and bbox as they would be written (6 decimals), without provenance and base_sha256.
std::string wall_lines_payload_sha256(const WallLines& lines);

/// Writes the artefact: sorted by id, one feature a line, 6 decimals (a diff shows one line per wall).
/// Returns whether the payload is new; equal payload keeps the file's time. Throws StageError(kCannotWrite).
bool write_wall_lines(const std::filesystem::path& path, const WallLines& lines,
                      const Provenance& provenance);

}  // namespace roomcut
