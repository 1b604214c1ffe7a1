// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

namespace roomcut {

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
