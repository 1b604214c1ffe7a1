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

/// The files a report is made of; each may be missing.
std::vector<StageFile> report_inputs();

/// What `only` may be besides "all": the names of the pipeline's runs, each drawing its own result;
/// "pictures", all that `make run` draws, without the page; "layers", the occupancy grids for QGIS.
std::vector<std::string> report_choices();

/// The pictures of one run of the pipeline, or those that give an overview of all ("all", "pictures"), in the
/// order of the pipeline, as far as the artefacts are there; `points`: the thinned scan, for "ingest" and the
/// overview. Models and clouds are rendered by other threads, while this one draws the rest and then does
/// `meanwhile`. Errors: those of the artefacts' readers.
std::vector<Picture> draw_pictures(const StageRun& run, const ReportParams& params, const std::string& only,
                                   const std::vector<ThinPoint>& points,
                                   const std::function<void()>& meanwhile);

/// The occupancy grid of each wall slice as files for QGIS: slice_<k>.png with slice_<k>.pgw and
/// slice_<k>.png.aux.xml, which say where it lies. `file` is the name, `bytes` the content.
std::vector<Picture> draw_layers(const StageRun& run);

/// The whole page: the template (option `template`) filled with the data of this run. Without a template (the
/// build could not fetch the front end) a page that says so, after a warning. Errors: those of the artefacts'
/// readers.
std::string make_page(StageRun& run, const std::vector<ThinPoint>& points);

}  // namespace roomcut::report
