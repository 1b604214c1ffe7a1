// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact_tool/commands.h"
#include "common/artefact_tool/tool_main.h"

int main(int argc, char** argv) {
  using namespace roomcut;
  return tool_main(argc, argv, [](Paths paths) {
    VerifyOptions options;
    while (paths.size() > 1 && (paths[0] == "--schemas" || paths[0] == "--scan")) {
      (paths[0] == "--scan" ? options.scan : options.schemas) = paths[1];
      paths.erase(paths.begin(), paths.begin() + 2);
    }
    if (paths.empty()) {
      std::cerr << "verify [--schemas FOLDER] [--scan FILE] STAMP …\n";
      return static_cast<int>(ExitCode::kUsage);
    }
    verify(paths, options);
    return 0;
  });
}
