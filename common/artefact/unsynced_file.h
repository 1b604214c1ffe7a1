// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

namespace roomcut {

/// Writes `text` beside `path` and renames it, like write_text_file(), but always anew and without waiting
/// for the disk: a killed process still leaves the old file or the new one, a machine that loses power may
/// leave an empty one. For what can be made again and is read by nobody but people and Make: logs, stamps,
/// pictures. A run has some sixty of them, and the disk takes milliseconds for each. Throws
/// StageError(kCannotWrite).
void write_unsynced_file(const std::filesystem::path& path, std::string_view text);

}  // namespace roomcut
