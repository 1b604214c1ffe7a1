// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace roomcut {

/// One line of a stamp: an output of a stage as it was when the stage had run.
struct StampEntry {
  std::string sha256;          ///< payload digest, or of the bytes for files that are no artefacts
  long long seconds = 0;       ///< modification time
  long nanoseconds = 0;        ///< its fraction
  std::filesystem::path path;  ///< relative to the work folder, i.e. the current folder
};

/// The entries of a stamp; none for a file that is missing or not a stamp.
std::vector<StampEntry> read_stamp(const std::filesystem::path& stamp);

/// Before a stage runs: `stamp` becomes `<stamp>.before`, so that a stage that is killed leaves none.
void withdraw_stamp(const std::filesystem::path& stamp);

/// After a stage ran: writes `stamp` for `outputs`. Those listed in `missing` (separated by spaces) take the
/// time of the entry of `<stamp>.before` when the digest is the same. Removes `<stamp>.before`. Throws
/// StageError when an output is missing or the stamp cannot be written.
void settle_stamp(const std::filesystem::path& stamp, const std::string& missing,
                  const std::vector<std::filesystem::path>& outputs);

}  // namespace roomcut
