// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/artefact_tool/rerun_plan.h"

namespace roomcut {

/// Before outputs that are no longer what their stage wrote are made again: moves those that a person may
/// have edited (all but HDF5) to edits/old/, so that nothing of theirs is lost. Returns a note for each such
/// output and for each that was damaged. Throws StageError(kCannotWrite).
std::vector<std::string> set_aside(const std::vector<StaleStage>& stale);

}  // namespace roomcut
