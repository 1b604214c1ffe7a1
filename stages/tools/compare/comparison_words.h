// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "stages/tools/compare/compare.h"
#include "stages/tools/compare/model_distance.h"

namespace roomcut::compare {

/// A comparison for the terminal: what differs, in as few lines as it takes.
std::string comparison_text(const RunFacts& a, const RunFacts& b, const Comparison& comparison,
                            const std::optional<ModelDistance>& distance);

/// The same as one page that needs no other file: plans side by side. `picture` is a PNG of B coloured by its
/// distance from A, or empty.
std::string comparison_html(const RunFacts& a, const RunFacts& b, const Comparison& comparison,
                            const std::optional<ModelDistance>& distance, const std::string& picture);

}  // namespace roomcut::compare
