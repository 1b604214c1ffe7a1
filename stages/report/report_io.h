// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/cli/run_stage.h"
#include "stages/report/page_points.h"
#include "stages/report/params.h"
#include "stages/report/pictures.h"

namespace roomcut {

/// The files a report is made of; each may be missing.
std::vector<StageFile> report_inputs();

/// The pictures of all stages whose artefacts are there, in the order of the pipeline; `only` names one stage
/// or is "all"; `points`: the thinned scan. Errors: those of the artefacts' readers.
std::vector<Picture> draw_pictures(const StageRun& run, const ReportParams& params, const std::string& only,
                                   const std::vector<ThinPoint>& points);

/// The whole page: the template (option `template`) filled with the data of this run. Without a template (the
/// build could not fetch the front end) a page that says so, after a warning. Errors: those of the artefacts'
/// readers.
std::string make_page(StageRun& run, const std::vector<ThinPoint>& points);

}  // namespace roomcut
