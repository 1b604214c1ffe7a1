// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "common/artefact/json.h"

// For sources that make JSON values or look into them; others, and headers, do with json.h. Text is made and
// parsed by its functions, never by members of Json: nlohmann's writer and parser are templates, compiled
// again in each source.
namespace roomcut {

/// nlohmann's message without its own prefix: "parse error at line 3, column 5: …".
std::string short_message(const Json::exception& error);

}  // namespace roomcut
