// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace roomcut {

/// Checks a JSON file against a JSON Schema (draft 7, by valijson); one text per violation, as
/// "features[3].properties.locked: …". Throws StageError(kArtefactDamaged) when one of the two is not JSON.
std::vector<std::string> schema_violations(const std::filesystem::path& file,
                                           const std::filesystem::path& schema);

}  // namespace roomcut
