// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "stages/ingest/number_text.h"
#include "stages/ingest/text_layout.h"
#include "stages/ingest/text_lines.h"

namespace roomcut {

inline const char* skip_blanks(const char* p, const char* end) {
  while (p < end && is_blank(*p)) {
    ++p;
  }
  return p;
}

/// Takes one line apart by a layout.
class LineParser {
 public:
  explicit LineParser(const TextLayout& layout) : layout_(layout) {}

  /// Returns whether [p, end) is a point; its numbers are in values().
  bool parse(const char* p, const char* end) {
    for (std::size_t i = 0; i < layout_.fields.size(); ++i) {
      p = skip_blanks(p, end);
      const int field = layout_.fields[i];
      p = field >= 0 ? take_number(p, end, values_[static_cast<std::size_t>(field)])
                     : (field == TextLayout::kList ? skip_list(p, end) : skip_field(p, end));
      if (p == nullptr) {
        return false;
      }
      if (i + 1 < layout_.fields.size() && (p = to_next_field(p, end)) == nullptr) {
        return false;
      }
    }
    return true;
  }
  const std::array<double, 6>& values() const { return values_; }

 private:
  bool ends_field(const char* p, const char* end) const {
    return p == end || is_blank(*p) || *p == layout_.separator;
  }
  const char* take_number(const char* p, const char* end, double& value) const {
    const char* stop = parse_number(p, end, value);
    return stop != nullptr && ends_field(stop, end) ? stop : nullptr;
  }
  const char* skip_field(const char* p, const char* end) const {
    while (p < end && *p != layout_.separator && !(layout_.separator == ' ' && is_blank(*p))) {
      ++p;
    }
    return p;
  }
  const char* skip_list(const char* p, const char* end) const {
    double count = 0;
    p = take_number(p, end, count);
    for (double i = 0; p != nullptr && i < count; ++i) {
      p = skip_blanks(p, end);
      p = p == end ? nullptr : skip_field(p, end);
    }
    return p;
  }
  const char* to_next_field(const char* p, const char* end) const {
    p = skip_blanks(p, end);
    if (layout_.separator == ' ') {
      return p;
    }
    return p < end && *p == layout_.separator ? p + 1 : nullptr;
  }

  const TextLayout& layout_;
  std::array<double, 6> values_{};
};

}  // namespace roomcut
