// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "common/artefact/provenance.h"
#include "common/artefact/types.h"
#include "common/openings/opening.h"

namespace roomcut {

namespace artefacts {
inline constexpr ArtefactType kOpenings{"openings", 2, 0};
}  // namespace artefacts

struct OpeningsFile {
  Openings content;
  std::string payload_sha256;
};

/// Reads an openings.geojson. Errors: kArtefactDamaged (naming the feature), …Type, …Version, …Missing.
OpeningsFile read_openings(const std::filesystem::path& path);
/// The same for the walls of one cells.h5: kArtefactMismatch when the file was made for other cells.
OpeningsFile read_openings(const std::filesystem::path& path, const std::string& cells_payload_sha256);

/// The whole text of the artefact.
std::string openings_text(const Openings& openings, const Provenance& provenance);

/// Writes the artefact: sorted by id, one feature a line, 6 decimals. Returns whether the payload is new; an
/// equal payload keeps the file's time. Throws StageError(kCannotWrite).
bool write_openings(const std::filesystem::path& path, const Openings& openings,
                    const Provenance& provenance);

}  // namespace roomcut
