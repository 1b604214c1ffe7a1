// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "stages/ingest/number_text.h"
#include "stages/ingest/text_layout.h"
#include "stages/ingest/text_lines.h"

namespace roomcut::ingest {

inline const char* skip_blanks(const char* p, const char* end) {
  while (p < end && is_blank(*p)) {
    ++p;
  }
  return p;
}

/// Takes one line apart by a layout. A coordinate that is missing (empty, NA, …) is NaN.
class LineParser {
 public:
  explicit LineParser(const TextLayout& layout)
      : layout_(layout), separator_(layout.dialect.separator), plain_(layout.dialect.plain()) {}

  /// Returns whether [p, end) is a point; its numbers are in values().
  bool parse(const char* p, const char* end) {
    p = skip_blanks(p, end);
    if (is_comment_line(p, end)) {
      return false;
    }
    for (std::size_t i = 0; i < layout_.fields.size(); ++i) {
      p = separator_ == '\t' ? p : skip_blanks(p, end);
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
    return p == end || is_blank(*p) || *p == separator_;
  }
  const char* take_number(const char* p, const char* end, double& value) const {
    if (plain_) {
      const char* stop = parse_number(p, end, value);
      if (stop != nullptr && ends_field(stop, end)) {
        return stop;
      }
    }
    return take_field(p, end, value);
  }
  /// What is no plain number: quoted, with a decimal comma, or missing.
  const char* take_field(const char* p, const char* end, double& value) const {
    const char* stop = skip_field(p, end);
    const char* last = stop;
    while (last > p && is_blank(last[-1])) {
      --last;
    }
    const std::string_view field(p, static_cast<std::size_t>(last - p));
    if (!plain_ && read_field(field, layout_.dialect, value)) {
      return stop;
    }
    if (!is_missing(field) || (field.empty() && separator_ == ' ')) {
      return nullptr;
    }
    value = std::numeric_limits<double>::quiet_NaN();
    return stop;
  }
  const char* skip_field(const char* p, const char* end) const {
    if (layout_.dialect.quotes && p < end && *p == '"') {
      p = std::find(p + 1, end, '"');
    }
    while (p < end && *p != separator_ && !(separator_ == ' ' && is_blank(*p))) {
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
    if (separator_ == '\t') {
      while (p < end && *p == ' ') {
        ++p;
      }
    } else {
      p = skip_blanks(p, end);
    }
    if (separator_ == ' ') {
      return p;
    }
    return p < end && *p == separator_ ? p + 1 : nullptr;
  }

  const TextLayout& layout_;
  char separator_;
  bool plain_;
  std::array<double, 6> values_{};
};

}  // namespace roomcut::ingest
