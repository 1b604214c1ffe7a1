// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/cli/run_stage.h"

namespace roomcut {

/// What `--describe` prints, JSON: {"name", "revision", "summary", "inputs" and "outputs" (option, default
/// path, optional, description), "options", "parameters" (name, type, unit, lowest, highest, choices,
/// default, auto, formula of auto, description)}. Numbers in the user's units.
std::string describe_program(const StageInfo& info, const ParameterTable& table);

}  // namespace roomcut
