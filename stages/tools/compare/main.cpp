// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "common/artefact/atomic_file.h"
#include "common/cli/run_stage.h"
#include "stages/tools/compare/comparison_json.h"
#include "stages/tools/compare/comparison_words.h"
#include "stages/tools/compare/read_run.h"

namespace {

using namespace roomcut;
using namespace roomcut::compare;

StageInfo info() {
  StageInfo stage;
  stage.name = "compare";
  stage.summary = "Compares two runs: parameters, lines, rooms, models";
  stage.inputs = {{"distance", "scores of evaluate: model B, truth A", true, false, "distance.json"},
                  {"picture", "picture of evaluate", true, false, "distance.png"}};
  stage.outputs = {{"comparison", "all that was found", false, false, "comparison.json"},
                   {"page", "the same as a page", false, false, "comparison.html"}};
  stage.options = {{"a", "", "one work folder", {}}, {"b", "", "the other one", {}}};
  return stage;
}

void body(StageRun& run) {
  const RunFacts a = read_run(run.option("a")), b = read_run(run.option("b"));
  const Comparison comparison = compare_runs(a, b);
  std::optional<ModelDistance> distance;
  if (run.has_input("distance")) {
    distance = read_distance(run.input("distance"));
  }
  const std::string picture = run.has_input("picture") ? read_text_file(run.input("picture")) : "";
  write_comparison(run.output("comparison"), a, b, comparison, distance, run.provenance());
  write_text_file(run.output("page"), comparison_html(a, b, comparison, distance, picture));
  if (!run.quiet()) {
    std::cout << comparison_text(a, b, comparison, distance);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(argc, argv, info(), {}, body);
}
