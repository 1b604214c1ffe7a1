// SPDX-License-Identifier: GPL-3.0-or-later

#include "common/picture/svg.h"
#include "stages/tools/compare/comparison_rows.h"
#include "stages/tools/compare/comparison_words.h"
#include "stages/tools/compare/storey_plans.h"

namespace roomcut::compare {

namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; img-src data:">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>roomcut comparison</title>
<style>
body { margin: 1em 1.5em 3em; font: 14px/1.45 system-ui, sans-serif; color: #1f2428; }
h1 { font-size: 1.3em; } h2 { font-size: 1.1em; margin: 1.6em 0 0.3em; } h3 { font-size: 1em; margin: 1em 0 0.2em; }
table { border-collapse: collapse; } td, th { border-bottom: 1px solid #c9d1d6; padding: 0.15em 0.9em 0.15em 0; text-align: left; vertical-align: top; }
th { color: #5b6770; } .number { text-align: right; font-variant-numeric: tabular-nums; }
.quiet { color: #5b6770; }
.plans { display: grid; grid-template-columns: repeat(3, 1fr); gap: 1em; } .plans figure { margin: 0; }
.plans svg { width: 100%; height: auto; border: 1px solid #c9d1d6; } figcaption { color: #5b6770; }
svg text { font-size: 10px; text-anchor: middle; } img { max-width: min(100%, 50em); }
.swatch { display: inline-block; width: 0.9em; height: 0.9em; margin: 0 0.3em 0 1em; vertical-align: -0.1em; }
@media print { .plans { break-inside: avoid; } }
</style>
</head>
<body>
)";

constexpr const char* kKey =
    "<p class=\"quiet\">Difference: <span class=\"swatch\" style=\"background:#e69f00\"></span>room or wall "
    "line in A only"
    "<span class=\"swatch\" style=\"background:#0072b2\"></span>in B only<span class=\"swatch\" "
    "style=\"background:#e6e8e9\"></span>room in both. Two lines beside each other: one that moved by 2 mm "
    "or more; the "
    "pointer on it says how far.</p>\n";

/// m2 and m3 as they are printed.
std::string with_powers(std::string words) {
  for (const auto& [plain, power] : {std::pair{"m2", "m²"}, {"m3", "m³"}}) {
    for (std::size_t at = words.find(plain); at != std::string::npos; at = words.find(plain, at)) {
      words.replace(at, 2, power);
    }
  }
  return words;
}

std::string cell(const char* tag, const std::string& word, bool number) {
  return std::string("<") + tag + (number ? " class=\"number\">" : ">") + with_powers(escaped(word)) + "</" +
         tag + ">";
}

std::string table_of(const WordTable& table) {
  std::string html = "<h2>" + escaped(table.title) + "</h2>\n";
  if (table.rows.empty()) {
    html += table.note.empty() ? "<p>No difference.</p>\n" : "";
  } else {
    html += "<table>\n<tr>";
    for (std::size_t i = 0; i < table.head.size(); ++i) {
      html += cell("th", table.head[i], is_number(table.rows.front()[i]));
    }
    html += "</tr>\n";
    for (const auto& row : table.rows) {
      html += "<tr>";
      for (const std::string& word : row) {
        html += cell("td", word, is_number(word));
      }
      html += "</tr>\n";
    }
    html += "</table>\n";
  }
  return html +
         (table.note.empty() ? "" : "<p class=\"quiet\">" + with_powers(escaped(table.note)) + "</p>\n");
}

std::string figure(const std::string& caption, const std::string& svg) {
  return "<figure>" + (svg.empty() ? "<p>There is no such storey.</p>" : svg) + "<figcaption>" +
         escaped(caption) + "</figcaption></figure>\n";
}

}  // namespace

std::string comparison_html(const RunFacts& a, const RunFacts& b, const Comparison& comparison,
                            const std::optional<ModelDistance>& distance, const std::string& picture) {
  std::string html = kHead;
  html += "<h1>A: " + escaped(a.name) + " – B: " + escaped(b.name) + "</h1>\n<p>" +
          (comparison.same_scan ? "The same scan." : "Two different scans.") + "</p>\n";
  html += table_of(parameter_rows(comparison)) + table_of(total_rows(a, b, true)) + "<h2>Plans</h2>\n" + kKey;
  for (const StoreyPlans& plan : draw_storeys(a, b, comparison)) {
    html += "<h3>" + escaped(plan.title) + "</h3>\n<div class=\"plans\">\n" + figure("A: " + a.name, plan.a) +
            figure("B: " + b.name, plan.b) + figure("Difference", plan.difference) + "</div>\n";
  }
  html += table_of(distance_rows(distance));
  if (!picture.empty()) {
    html += "<p><img alt=\"The model of B, coloured by its distance from A\" src=\"data:image/png;base64," +
            base64({reinterpret_cast<const std::uint8_t*>(picture.data()), picture.size()}) +
            "\"></p>\n<p class=\"quiet\">B, coloured by its distance from A: dark is 0, yellow 5 cm and "
            "more.</p>\n";
  }
  constexpr std::size_t kAll = 1000000;
  html += table_of(line_rows(a, b, comparison, kAll)) + table_of(room_rows(a, b, comparison));
  return html + "</body>\n</html>\n";
}

}  // namespace roomcut::compare
