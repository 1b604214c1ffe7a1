// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iostream>
#include <iterator>

#include "common/artefact_digest/artefact_digest.h"
#include "common/artefact_tool/commands.h"
#include "common/artefact_tool/set_aside.h"
#include "common/artefact_tool/status.h"
#include "common/rerun/work_digests.h"

namespace roomcut {

namespace {

std::vector<PipelineStage> pipeline_from_stdin() {
  return parse_pipeline({std::istreambuf_iterator<char>(std::cin), {}});
}

/// Marks of the run before go, and those come without which a reader could be passed over.
void prepare_marks(const std::vector<PipelineStage>& needed) {
  for (const PipelineStage& stage : needed) {
    unmark_changed("stamps/" + stage.name);
  }
  for (const std::string& name : differently_read(needed)) {
    mark_changed("stamps/" + name);
  }
}

}  // namespace

void print_plan(const PlanOptions& options, const std::vector<std::string>& goals) {
  const std::vector<PipelineStage> needed = needed_for(pipeline_from_stdin(), goals);
  WorkDigests digests(payload_digest, options.scan);
  const auto content_of = [&](const std::string& name) { return digests.of(name); };
  const std::vector<StaleStage> stale = find_stale(needed, content_of, options.again);
  digests.save();
  const bool unknown = std::any_of(stale.begin(), stale.end(), [](const StaleStage& stage) {
    return stage.stamp == StampState::kUnknown;
  });
  if (unknown) {
    std::cerr << "note: stamps of an older roomcut, or cut short, do not say what was read: their stages run "
                 "once more\n";
  }
  for (const std::string& note : set_aside(stale)) {
    std::cerr << "note: " << note << "\n";
  }
  if (stale.empty()) {
    return;
  }
  prepare_marks(needed);
  const auto waits = waits_for(needed, stale);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const auto is_it = [&](const StaleStage& stage) { return stage.name == needed[i].name; };
    if (std::any_of(stale.begin(), stale.end(), is_it)) {
      std::cout << needed[i].name << "\n";
    } else if (!waits[i].empty()) {
      std::cout << "?" << needed[i].name << "\n";
    }
  }
}

void print_status(const PlanOptions& options) {
  const std::vector<PipelineStage> pipeline = pipeline_from_stdin();
  WorkDigests digests(payload_digest, options.scan);
  print_status(pipeline, find_stale(pipeline, [&](const std::string& name) { return digests.of(name); }));
}

}  // namespace roomcut
