// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "stages/tools/compare/comparison_rows.h"
#include "stages/tools/compare/comparison_words.h"

namespace roomcut::compare {

namespace {

constexpr std::size_t kMostLines = 12;  // the page lists all

std::string padded(const std::string& word, std::size_t width) {
  const std::string blanks(width - std::min(width, word.size()), ' ');
  return is_number(word) ? blanks + word : word + blanks;
}

std::string text_of(const WordTable& table) {
  std::vector<std::size_t> widths(table.head.size());
  for (std::size_t i = 0; i < widths.size(); ++i) {
    widths[i] = table.head[i].size();
    for (const auto& row : table.rows) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  const auto row_text = [&](const std::vector<std::string>& row) {
    std::string text = " ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += " " + padded(row[i], widths[i]) + " ";
    }
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  };
  std::string text = table.title + "\n";
  if (!table.rows.empty()) {
    text += row_text(table.head);
  }
  for (const auto& row : table.rows) {
    text += row_text(row);
  }
  return text + (table.note.empty() ? "" : "  " + table.note + "\n");
}

}  // namespace

std::string comparison_text(const RunFacts& a, const RunFacts& b, const Comparison& comparison,
                            const std::optional<ModelDistance>& distance) {
  std::string text = "A " + a.name + "\nB " + b.name + "\n";
  text += comparison.same_scan ? "The same scan.\n" : "Two different scans.\n";
  for (const WordTable& table : {parameter_rows(comparison), total_rows(a, b, false), distance_rows(distance),
                                 line_rows(a, b, comparison, kMostLines), room_rows(a, b, comparison)}) {
    text += table.rows.empty() && table.note.empty() ? table.title + "\n  no difference\n" : text_of(table);
  }
  return text;
}

}  // namespace roomcut::compare
