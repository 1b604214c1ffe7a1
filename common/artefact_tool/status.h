// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/artefact_tool/rerun_plan.h"

namespace roomcut {

/// What differs between two resolved parameter objects, as "parameter mu_m changed 0.3 -> 0.5"; texts that
/// are no JSON objects differ in nothing.
std::vector<std::string> describe_parameters(const std::string& before, const std::string& after);

/// Prints one line per stage of the work folder that is the current one: fresh, stale and why, or what it
/// waits for; edited where a hand edit is in force.
void print_status(const std::vector<PipelineStage>& pipeline, const std::vector<StaleStage>& stale);

}  // namespace roomcut
