// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "common/artefact/provenance.h"
#include "stages/tools/compare/compare.h"
#include "stages/tools/compare/model_distance.h"

namespace roomcut::compare {

/// From the scores of `evaluate` with A as the truth. Errors: those of read_json_artefact().
ModelDistance read_distance(const std::filesystem::path& scores);

/// All that was found, for programs to read; schemas/comparison.md.
void write_comparison(const std::filesystem::path& path, const RunFacts& a, const RunFacts& b,
                      const Comparison& comparison, const std::optional<ModelDistance>& distance,
                      const Provenance& provenance);

}  // namespace roomcut::compare
