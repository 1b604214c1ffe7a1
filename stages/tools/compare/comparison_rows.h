// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "stages/tools/compare/compare.h"
#include "stages/tools/compare/model_distance.h"

namespace roomcut::compare {

/// A table of words; numbers in them are aligned to the right.
struct WordTable {
  std::string title;
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
  std::string note;  ///< a sentence below it, or empty
};

/// A number with its decimals, never "-0".
std::string fixed_number(double value, int decimals);

/// Whether a word stands to the right.
bool is_number(const std::string& word);

// What a comparison says, as tables for the terminal and the page. Without rows: there is nothing to say.

WordTable parameter_rows(const Comparison& comparison);
/// Figures of both runs; `all` also those that are equal.
WordTable total_rows(const RunFacts& a, const RunFacts& b, bool all);
WordTable distance_rows(const std::optional<ModelDistance>& distance);
/// At most `most` lines that moved by more than a millimetre, then those that only one run has.
WordTable line_rows(const RunFacts& a, const RunFacts& b, const Comparison& comparison, std::size_t most);
/// Rooms whose area or volume differs, then those that only one run has.
WordTable room_rows(const RunFacts& a, const RunFacts& b, const Comparison& comparison);

}  // namespace roomcut::compare
