// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/rerun/stamp.h"

namespace roomcut {

/// A stage of the pipeline as stages/pipeline.mk declares it.
struct PipelineStage {
  std::string name, program;
  std::vector<std::string> outputs, inputs;
};

/// "name program : outputs : inputs", one stage a line, in the order of the pipeline.
std::vector<PipelineStage> parse_pipeline(const std::string& text);

/// A stage that must run, and why. Its inputs that another such stage makes are not among the reasons: they
/// may come out as they were.
struct StaleStage {
  std::string name;
  StampState stamp = StampState::kWhole;  ///< anything else is the reason by itself
  bool asked_for = false;                 ///< the user wants it to run again
  std::vector<std::string> changed;       ///< inputs that are not what it read
  std::vector<std::string> missing;       ///< outputs
  std::vector<std::string> damaged;       ///< outputs that are not what it wrote
};

/// The one answer to "what must run, and why": the stages that must, in the order of the pipeline.
/// `content_of` says what the files hold now (WorkDigests). `again`: a stage that the user wants to run in
/// any case; may be empty.
std::vector<StaleStage> find_stale(const std::vector<PipelineStage>& pipeline, const DigestOf& content_of,
                                   const std::string& again = "");

/// For each stage the nearest stale stages before it, in the order of the pipeline: unless it is stale itself
/// it runs only if one of them comes out different. Parallel to `pipeline`.
std::vector<std::vector<std::string>> waits_for(const std::vector<PipelineStage>& pipeline,
                                                const std::vector<StaleStage>& stale);

/// Those stages whose readers cannot rely on "it came out as before": a reader among those that wait has read
/// another version of an output than the stage made last. So it is after a run that was killed between the
/// two.
std::vector<std::string> differently_read(const std::vector<PipelineStage>& pipeline);

/// The stages that a run up to and including `goals` is made of, in the order of the pipeline. "run" is all
/// of them.
std::vector<PipelineStage> needed_for(const std::vector<PipelineStage>& pipeline,
                                      const std::vector<std::string>& goals);

}  // namespace roomcut
