// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "common/artefact/h5.h"
#include "common/artefact_tool/commands.h"
#include "common/artefact_tool/status.h"
#include "common/errors/codes.h"

namespace {

using namespace roomcut;
using Paths = std::vector<std::filesystem::path>;

constexpr const char* kUsage =
    "artefact show|digest|bytes FILE …   artefact input FILE NAME\n"
    "artefact status PIPELINE STALE\n"
    "artefact verify [--schemas FOLDER] [--scan FILE] STAMP …\n";

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

bool print_input(const std::filesystem::path& path, const std::string& name) {
  for (const InputRecord& input : read_provenance(path).inputs) {
    if (input.name == name) {
      std::cout << input.payload_sha256 << "\n";
      return true;
    }
  }
  return false;
}

/// Takes "--schemas FOLDER" and "--scan FILE" off the front.
VerifyOptions take_options(Paths& paths) {
  VerifyOptions options;
  while (paths.size() > 1 && (paths[0] == "--schemas" || paths[0] == "--scan")) {
    (paths[0] == "--scan" ? options.scan : options.schemas) = paths[1];
    paths.erase(paths.begin(), paths.begin() + 2);
  }
  return options;
}

int run(const std::string& command, Paths paths) {
  if (command == "verify") {
    const VerifyOptions options = take_options(paths);
    verify(paths, options);
  } else if (command == "status" && paths.size() == 2) {
    print_status(parse_pipeline(read_text_file(paths[0])), parse_stale(read_text_file(paths[1])));
  } else if (command == "input" && paths.size() == 2) {
    return print_input(paths[0], paths[1].string()) ? 0 : static_cast<int>(ExitCode::kInput);
  } else if (command == "show" || command == "digest" || command == "bytes") {
    for (const std::filesystem::path& path : paths) {
      if (command == "show") {
        show(path);
      } else {
        std::cout << (command == "bytes" ? sha256_of_file(path) : inspect_artefact(path).payload_sha256)
                  << "\n";
      }
    }
  } else {
    std::cerr << kUsage;
    return static_cast<int>(ExitCode::kUsage);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc > 1 ? argv[1] : "", argc > 2 ? Paths(argv + 2, argv + argc) : Paths());
  } catch (const StageError& error) {
    for (const Problem& problem : error.problems()) {
      std::cerr << to_string(problem);
    }
    return static_cast<int>(error.exit_code());
  } catch (const std::exception& error) {
    std::cerr << "artefact: unexpected: " << error.what() << "\n";
    return static_cast<int>(ExitCode::kBug);
  }
}
