// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace roomcut {

/// A stage of the pipeline as stages/pipeline.mk declares it.
struct PipelineStage {
  std::string name, program;
  std::vector<std::string> outputs, inputs;
};

/// A stage that Make would run, with the prerequisites that are newer than its stamp and its outputs that
/// are missing.
struct StaleStage {
  std::string name;
  std::vector<std::string> changed, missing;
};

/// "name program : outputs : inputs", one stage a line, in the order of the pipeline.
std::vector<PipelineStage> parse_pipeline(const std::string& text);
/// "name changed … missing:file …", one stage a line.
std::vector<StaleStage> parse_stale(const std::string& text);

/// What differs between two resolved parameter objects, as "parameter mu_m changed 0.3 -> 0.5"; texts that
/// are no JSON objects differ in nothing.
std::vector<std::string> describe_parameters(const std::string& before, const std::string& after);

/// The stages that a run reaches only if what they read comes out different: for each the nearest stale
/// stages before it, none for a stage that waits for nothing. Parallel to `pipeline`.
std::vector<std::vector<std::string>> waits_for(const std::vector<PipelineStage>& pipeline,
                                                const std::vector<StaleStage>& stale);

/// Prints one line per stage of the work folder that is the current one: fresh, stale and why, or what it
/// waits for; edited where a hand edit is in force.
void print_status(const std::vector<PipelineStage>& pipeline, const std::vector<StaleStage>& stale);

}  // namespace roomcut
