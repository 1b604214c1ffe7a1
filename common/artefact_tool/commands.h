// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
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

struct PlanOptions {
  std::filesystem::path scan;  ///< where the scan lies now
  std::string again;           ///< a stage that is to run in any case; may be empty
};

/// Reads the pipeline (parse_pipeline()) from standard input and prints for Make, one a line, the names of
/// the stages up to and including `goals` that must run, and as "?name" those that run only if one of the
/// former comes out different (mark_changed()). The work folder is the current one. Outputs that were changed
/// by hand are moved aside first (set_aside()); notes go to standard error. Throws StageError(kCannotWrite).
void print_plan(const PlanOptions& options, const std::vector<std::string>& goals);

/// Reads the pipeline from standard input and prints a line per stage; changes nothing.
void print_status(const PlanOptions& options);

}  // namespace roomcut
