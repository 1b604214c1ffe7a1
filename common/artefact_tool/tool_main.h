// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <vector>

#include "common/errors/error.h"

namespace roomcut {

using Paths = std::vector<std::filesystem::path>;

/// What a program of this folder does with its arguments; errors go to standard error. Returns the exit code.
inline int tool_main(int argc, char** argv, const std::function<int(Paths)>& run) {
  try {
    return run(Paths(argv + 1, argv + argc));
  } catch (const StageError& error) {
    for (const Problem& problem : error.problems()) {
      std::cerr << to_string(problem);
    }
    return static_cast<int>(error.exit_code());
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": unexpected: " << error.what() << "\n";
    return static_cast<int>(ExitCode::kBug);
  }
}

}  // namespace roomcut
