// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cli/run_stage.h"
#include "stages/tools/report/page_points.h"

namespace roomcut::report {

/// Every n-th point of the input `cloud`, so that at most about `most` remain, tile by tile; of a scan with a
/// model only the points within a metre of its box, since ghosts far outside would make everything else
/// small. One pass over the points, some thousands of them in memory. Errors: those of the artefacts'
/// readers.
std::vector<ThinPoint> thinned_points(const StageRun& run, std::uint64_t most);

}  // namespace roomcut::report
