// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "common/artefact/provenance.h"

namespace roomcut {

/// What the artefact at `path` states of itself (type, version, payload digest), after everything that it
/// holds was compared with that digest. For a file that is no artefact: the digest of its bytes, type "".
/// Never from memory: the file is read. Errors: kArtefactMissing; kArtefactDamaged when the content is not
/// what its writer wrote, or cannot be read; kArtefactVersion. Thread-safe; the same for any threads.
InputRecord verified_artefact(const std::filesystem::path& path);

/// verified_artefact()'s digest alone.
std::string payload_digest(const std::filesystem::path& path);

}  // namespace roomcut
