// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

namespace roomcut {

/// Checks every output of the stamps; prints "ok" lines to stdout. Throws StageError with all findings.
void verify(const std::vector<std::filesystem::path>& stamps);

}  // namespace roomcut
