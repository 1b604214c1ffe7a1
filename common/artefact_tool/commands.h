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

/// Writes `stamp` for `outputs`. Those listed in `missing` (separated by spaces) take the time of the entry
/// of
/// `<stamp>.before` when the digest is the same. Removes `<stamp>.before`.
/// Throws StageError when an output is missing or the stamp cannot be written.
void settle(const std::filesystem::path& stamp, const std::string& missing,
            const std::vector<std::filesystem::path>& outputs);

/// What verify() looks at besides the digests; empty = not looked at.
struct VerifyOptions {
  std::filesystem::path schemas;  ///< folder of <artefact>.schema.json
  std::filesystem::path scan;     ///< file that the first artefact was made from
};

/// Checks every output of the stamps: the digest that the stamp and the file state, the content's own digest,
/// the inputs that its provenance names, JSON files against their schema, and of a model its mesh (closed,
/// oriented, 2-manifold, no self-intersection, the volume that the summary states). Prints "ok" lines to
/// stdout. Throws StageError with all findings.
void verify(const std::vector<std::filesystem::path>& stamps, const VerifyOptions& options);

}  // namespace roomcut
