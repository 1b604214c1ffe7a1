// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/cli/run_stage.h"
#include "stages/tools/report/pictures.h"

namespace roomcut::report {

/// The names of the report's inputs that one pass over the cells reads and writes.
struct PassInputs {
  std::string cells, weights, terms, labels;
};

// The pictures of the stages that work on cells; `stage` is the name of the run. Layers where all is solid,
// or that lie between close levels, show nothing and are left out. Errors: those of the artefacts' readers.

void draw_partition_of(const StageRun& run, const PassInputs& inputs, const std::string& stage,
                       std::vector<Picture>& pictures);
void draw_weights_of(const StageRun& run, const PassInputs& inputs, const std::string& stage,
                     std::vector<Picture>& pictures);
void draw_evidence_of(const StageRun& run, const PassInputs& inputs, const std::string& stage,
                      std::vector<Picture>& pictures);
void draw_labels_of(const StageRun& run, const PassInputs& inputs, const std::string& stage,
                    std::vector<Picture>& pictures);
/// One picture for each level that has a surface.
void draw_surfaces_of(const StageRun& run, const PassInputs& inputs, std::vector<Picture>& pictures);
void draw_openings_of(const StageRun& run, const PassInputs& inputs, std::vector<Picture>& pictures);

}  // namespace roomcut::report
