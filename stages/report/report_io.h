// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "common/cli/run_stage.h"
#include "stages/report/page.h"
#include "stages/report/params.h"
#include "stages/report/pictures.h"

namespace roomcut {

/// The files a report is made of; each may be missing.
std::vector<StageFile> report_inputs();

/// The pictures of all stages whose artefacts are there, in the order of the pipeline; `only` names one stage
/// or is "all". Errors: those of the artefacts' readers.
std::vector<Picture> draw_pictures(const StageRun& run, const ReportParams& params, const std::string& only);

/// Storeys, rooms and checks from summary.json.
std::vector<ReportTable> summary_tables(const std::filesystem::path& summary);

}  // namespace roomcut
