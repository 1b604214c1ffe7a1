// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "common/artefact/json.h"
#include "stages/tools/compare/compare.h"
#include "stages/tools/compare/model_distance.h"

namespace roomcut::compare {

inline constexpr ArtefactType kComparison{"comparison", 1, 0};

/// From the scores of `evaluate` with A as the truth. Errors: those of read_json_artefact().
ModelDistance read_distance(const std::filesystem::path& scores);

/// All that was found, for programs to read; schemas/comparison.md.
Json comparison_json(const RunFacts& a, const RunFacts& b, const Comparison& comparison,
                     const std::optional<ModelDistance>& distance);

}  // namespace roomcut::compare
