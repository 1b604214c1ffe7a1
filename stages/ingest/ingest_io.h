// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/cli/run_stage.h"
#include "stages/ingest/params.h"

namespace roomcut::ingest {

StageInfo ingest_info();
/// Reads the scan, writes cloud.h5, tells the user what was dropped and what the cloud is like.
void run_ingest(StageRun& run, const IngestParams& params);

}  // namespace roomcut::ingest
