// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/cli/run_stage.h"
#include "stages/tools/report/page_points.h"
#include "stages/tools/report/params.h"
#include "stages/tools/report/pictures.h"

namespace roomcut::report {

/// How the result of one run of the pipeline is drawn.
struct StageDrawing {
  std::string stage;
  std::vector<std::string> needs;  ///< inputs without which there is nothing to draw
  bool overview;                   ///< whether `make run` draws it
  bool rendered;                   ///< pixel by pixel, and without HDF5: draw() may run beside others
  std::function<void(const StageRun&, const ReportParams&, std::vector<Picture>&)> draw;
};

/// Of every run that has a result, in the order of the pipeline. `points`, the thinned scan, must outlive
/// them.
std::vector<StageDrawing> stage_drawings(const std::vector<ThinPoint>& points);

}  // namespace roomcut::report
