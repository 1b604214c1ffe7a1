// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/edit_values.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "common/artefact/json_values.h"
#include "common/text/words.h"

namespace roomcut {

std::string trimmed_text(const Json& value) {
  return value.is_string() ? std::string(trimmed(value.get<std::string>())) : canonical_json(value);
}

std::optional<double> number_of(const Json& value) {
  if (value.is_number()) {
    return value.get<double>();
  }
  if (!value.is_string()) {
    return std::nullopt;
  }
  const std::string text(trimmed(value.get<std::string>()));
  double number = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
  return !text.empty() && end.ec == std::errc() && end.ptr == text.data() + text.size()
             ? std::optional(number)
             : std::nullopt;
}

std::optional<bool> truth_of(const Json& value) {
  if (value.is_boolean()) {
    return value.get<bool>();
  }
  std::string text = trimmed_text(value);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  if (text == "true" || text == "t" || text == "yes" || text == "1") {
    return true;
  }
  if (text == "false" || text == "f" || text == "no" || text == "0" || text.empty()) {
    return false;
  }
  return std::nullopt;
}

std::optional<std::string> id_of(const Json& value) {
  constexpr std::size_t kLongest = 64;
  if (value.is_null()) {
    return std::string();
  }
  const bool usable = value.is_string() || value.is_number_integer();
  std::string id = trimmed_text(value);
  const auto control = [](unsigned char c) { return c < 0x20; };
  if (!usable || id.size() > kLongest || std::any_of(id.begin(), id.end(), control)) {
    return std::nullopt;
  }
  return id;
}

bool is_digest(std::string_view text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

}  // namespace roomcut
