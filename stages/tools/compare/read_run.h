// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "stages/tools/compare/run_facts.h"

namespace roomcut::compare {

/// Reads a work folder. What is not there yet is left out, but a folder without any scan that was read is an
/// error (kArtefactMissing). Other errors: those of the artefacts' readers.
RunFacts read_run(const std::filesystem::path& folder);

}  // namespace roomcut::compare
