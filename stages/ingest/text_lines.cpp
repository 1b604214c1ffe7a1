// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/text_lines.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace roomcut::ingest {

namespace {

/// Calls visit(first, last) for each piece of [begin, end) in order, until it returns false.
template <class Visit>
void scan_bytes(const ScanBytes& text, std::uint64_t begin, std::uint64_t end, Visit&& visit) {
  std::vector<char> bytes(1 << 20);
  while (begin < end) {
    const std::size_t wanted = static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), end - begin));
    const std::size_t got = text.read(begin, bytes.data(), wanted);
    if (got == 0 || !visit(bytes.data(), bytes.data() + got)) {
      return;
    }
    begin += got;
  }
}

}  // namespace

std::uint64_t line_number(const ScanBytes& text, std::uint64_t offset) {
  std::uint64_t breaks = 0;
  scan_bytes(text, 0, offset, [&](const char* first, const char* last) {
    breaks += static_cast<std::uint64_t>(std::count(first, last, '\n'));
    return true;
  });
  return breaks + 1;
}

std::uint64_t end_of_lines(const ScanBytes& text, std::uint64_t begin, std::uint64_t lines,
                           std::uint64_t& found) {
  std::uint64_t end = begin;
  std::uint64_t position = begin;
  bool blank = true;
  found = 0;
  scan_bytes(text, begin, text.size(), [&](const char* first, const char* last) {
    for (const char* p = first; p < last && found < lines;) {
      const auto* stop = static_cast<const char*>(std::memchr(p, '\n', static_cast<std::size_t>(last - p)));
      const char* line_end = stop == nullptr ? last : stop;
      blank = blank && std::all_of(p, line_end, is_blank);
      p = stop == nullptr ? last : stop + 1;
      if (stop != nullptr) {
        found += blank ? 0 : 1;
        blank = true;
      }
      end = position + static_cast<std::uint64_t>(p - first);
    }
    position += static_cast<std::uint64_t>(last - first);
    return found < lines;
  });
  if (found < lines && !blank) {
    ++found;  // a last line without a line break
  }
  return end;
}

}  // namespace roomcut::ingest
