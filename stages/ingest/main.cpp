// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cli/run_stage.h"
#include "stages/ingest/ingest_io.h"

int main(int argc, char** argv) {
  using namespace roomcut;
  using namespace roomcut::ingest;
  IngestParams params;
  return run_stage(argc, argv, ingest_info(), parameters(params),
                   [&params](StageRun& run) { run_ingest(run, params); });
}
