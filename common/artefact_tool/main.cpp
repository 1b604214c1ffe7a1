// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "common/artefact/h5.h"
#include "common/artefact_tool/commands.h"
#include "common/artefact_tool/tool_main.h"
#include "common/errors/codes.h"
#include "common/pipeline/pipeline_table.h"

namespace {

using namespace roomcut;

constexpr const char* kUsage =
    "artefact show|digest|bytes FILE …\n"
    "artefact plan [--scan FILE] [--again STAGE] GOAL … < PIPELINE   artefact status [--scan FILE] < "
    "PIPELINE\n"
    "artefact rules\n";

void show(const std::filesystem::path& path) {
  const InputRecord record = inspect_artefact(path);
  std::cout << path.string() << "\n  " << (record.artefact.empty() ? "no artefact" : record.artefact) << " "
            << record.schema_version << "\n  payload " << record.payload_sha256 << "\n";
  if (record.artefact.empty()) {
    return;
  }
  const Provenance provenance = read_provenance(path);
  std::cout << "  stage   " << provenance.stage << ", revision " << provenance.stage_revision
            << "\n  params  " << provenance.params_json << "\n";
  for (const InputRecord& input : provenance.inputs) {
    std::cout << "  input   " << input.name << ": " << input.path << " (" << input.artefact << " "
              << input.schema_version << ") " << input.payload_sha256 << "\n";
  }
}

/// "--scan FILE" and "--again STAGE" in front, then goals.
int plan_or_status(const std::string& command, Paths paths) {
  PlanOptions options;
  while (paths.size() > 1 && (paths[0] == "--scan" || paths[0] == "--again")) {
    if (paths[0] == "--scan") {
      options.scan = paths[1];
    } else {
      options.again = paths[1].string();
    }
    paths.erase(paths.begin(), paths.begin() + 2);
  }
  if (command == "status") {
    print_status(options);
  } else {
    print_plan(options, {paths.begin(), paths.end()});
  }
  return 0;
}

int run(const std::string& command, Paths paths) {
  if (command == "plan" || command == "status") {
    return plan_or_status(command, std::move(paths));
  } else if (command == "show" || command == "digest" || command == "bytes") {
    for (const std::filesystem::path& path : paths) {
      if (command == "show") {
        show(path);
      } else {
        std::cout << (command == "bytes" ? sha256_of_file(path) : inspect_artefact(path).payload_sha256)
                  << "\n";
      }
    }
  } else if (command == "rules") {
    for (const PipelineRun& part : pipeline_table().runs()) std::cout << make_rule(pipeline_table(), part);
  } else {
    std::cerr << kUsage;
    return static_cast<int>(ExitCode::kUsage);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return tool_main(argc, argv, [](Paths paths) {
    const std::string command = paths.empty() ? "" : paths[0].string();
    return run(command, paths.empty() ? paths : Paths(paths.begin() + 1, paths.end()));
  });
}
