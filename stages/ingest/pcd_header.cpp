// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/pcd_header.h"

#include <algorithm>
#include <string_view>

namespace roomcut {

namespace {

constexpr std::size_t kLargestHeader = 1 << 14;

}  // namespace

bool is_pcd(const ScanBytes& text) {
  std::string head(kLargestHeader, '\0');
  head.resize(text.read(0, head.data(), head.size()));
  bool fields = false;
  for (std::size_t begin = 0; begin < head.size();) {
    const std::size_t end = std::min(head.find('\n', begin), head.size());
    const std::string_view line = std::string_view(head).substr(begin, end - begin);
    if (begin == 0 && (line.starts_with("# .PCD") || line.starts_with("#.PCD"))) {
      return true;
    }
    fields = fields || line.starts_with("FIELDS ") || line.starts_with("COLUMNS ");
    if (fields && line.starts_with("DATA ")) {
      return true;
    }
    begin = end + 1;
  }
  return false;
}

}  // namespace roomcut
