// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace roomcut::report {

/// How often `part` stands in `text`.
inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

}  // namespace roomcut::report
