// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/json_values.h"
#include "common/artefact_tool/status.h"

namespace roomcut {

std::vector<std::string> describe_parameters(const std::string& before, const std::string& after) {
  const Json old = try_parse_json(before);
  const Json now = try_parse_json(after);
  std::vector<std::string> text;
  if (!old.is_object() || !now.is_object()) {
    return text;
  }
  const auto word = [](const Json& value) {
    return value.is_string() ? value.get<std::string>() : canonical_json(value);
  };
  for (const auto& [key, value] : now.items()) {
    if (!old.contains(key)) {
      text.push_back("parameter " + key + " is new (" + word(value) + ")");
    } else if (old[key] != value) {
      text.push_back("parameter " + key + " changed " + word(old[key]) + " -> " + word(value));
    }
  }
  for (const auto& [key, value] : old.items()) {
    if (!now.contains(key)) {
      text.push_back("parameter " + key + " is gone");
    }
  }
  return text;
}

}  // namespace roomcut
