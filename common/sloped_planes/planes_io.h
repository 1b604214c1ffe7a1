// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/sloped_planes/accepted_planes.h"

namespace roomcut {

/// A planes.geojson with what the file says of itself.
struct PlanesFile {
  AcceptedPlanes content;
  Provenance provenance;
  std::string payload_sha256;  ///< digest of the canonical content without provenance and base_sha256
  std::vector<std::string> warnings;
};

/// Reads a file written by a stage. Strict: any problem is an error (kArtefact… codes).
PlanesFile read_planes_file(const std::filesystem::path& path);

/// Reads a file that a person or another program may have written (rules: schemas/planes.md): tolerant where
/// the meaning is clear, with warnings; otherwise StageError with ALL problems of the file. `base`, which is
/// normalised, supplies frame, box, levels and, by plane_id, what an editor dropped; planes that differ from
/// it become `edited` or `added`. The result is normalised.
PlanesFile read_edited_planes(const std::filesystem::path& path, const AcceptedPlanes& base);

/// Digest of planes, levels, frame and bbox as they would be written.
std::string planes_payload_sha256(const AcceptedPlanes& planes);

/// Writes the artefact: sorted by id, one feature a line. Returns whether the payload is new; equal payload
/// keeps the file's time. Throws StageError(kCannotWrite).
bool write_planes_file(const std::filesystem::path& path, const AcceptedPlanes& planes,
                       const Provenance& provenance);

}  // namespace roomcut
