// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "stages/view/request_rules.h"

namespace roomcut {

/// The bytes of a served file; nullopt when it is missing, no plain file, or reached through a symbolic
/// link, which could lead out of the work folder.
std::optional<std::string> read_work_file(const std::filesystem::path& work, const ServedFile& file);

}  // namespace roomcut
