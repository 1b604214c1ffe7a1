// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "common/artefact/types.h"

namespace roomcut {

/// "1.0"
std::string version_text(ArtefactType type);

/// Refuses another type (kArtefactType), another major or a newer minor version (kArtefactVersion), naming
/// both; an empty `artefact` or a version that is not "major.minor" is kArtefactDamaged.
void check_type_and_version(const std::filesystem::path& path, const std::string& artefact,
                            const std::string& version, ArtefactType expected);

/// The payload digest that the file at `path` states; empty when there is no such file or it states none.
std::string stated_payload(const std::filesystem::path& path);

/// The canonical payload digest of a plain JSON artefact's text: all members but `provenance`. "" when it is
/// not JSON.
std::string json_payload_sha256(const std::string& text);

}  // namespace roomcut
