// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace roomcut {

/// The payload digest of an artefact of any type as its content has it, whatever the file states; of a file
/// that is no artefact the digest of its bytes. Reads all of it. Throws StageError when it cannot be read.
std::string actual_digest(const std::filesystem::path& path);

}  // namespace roomcut
