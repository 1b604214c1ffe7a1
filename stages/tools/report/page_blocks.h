// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/cli/run_stage.h"
#include "stages/tools/report/page_block.h"
#include "stages/tools/report/page_points.h"

namespace roomcut::report {

// The blocks of the page's data, each from the artefacts that are there; the page copes with missing ones.
// What is in them: page/README.md. Errors: those of the artefacts' readers.

/// `run`: summary, levels, histogram, parameters of each stage, noise and density. `lines`: detected,
/// accepted and refined wall lines and the openings as their files hold them.
void add_run_blocks(const StageRun& run, std::vector<PageBlock>& blocks);

/// `logs`: times, memory, chosen values, counts and warnings of each stage, from logs/. The only block that
/// differs between equal runs.
void add_log_block(const StageRun& run, std::vector<PageBlock>& blocks);

/// `slice-<k>`: the occupied cells of wall slice k, and which of them are wall or clutter. `cells`: the cell
/// complex with weights, evidence, costs and labels, of the second pass where there is one.
void add_plan_blocks(const StageRun& run, std::vector<PageBlock>& blocks);

/// `model`: the triangles with kind, storey, region; `cloud`: the thinned scan with distances from the model.
void add_model_blocks(const StageRun& run, const std::vector<ThinPoint>& points,
                      std::vector<PageBlock>& blocks);

}  // namespace roomcut::report
