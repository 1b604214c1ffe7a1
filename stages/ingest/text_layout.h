// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "stages/ingest/scan_bytes.h"

namespace roomcut {

/// What one line of a text cloud consists of.
struct TextLayout {
  static constexpr int kSkip = -1;  ///< a field that is not used
  static constexpr int kList = -2;  ///< a count and as many numbers (ascii PLY)

  char separator = ' ';  ///< ' ' stands for any run of spaces and tabs
  std::vector<int>
      fields;  ///< per field up to the last used one: kSkip, kList or 0 … 5 for x, y, z, nx, ny, nz
  bool normals = false;
  std::uint64_t begin = 0;                ///< first byte that may belong to a point
  std::uint64_t end = 0;                  ///< byte after the last
  std::optional<std::uint64_t> promised;  ///< points that a count line promises (.pts)
};

/// Finds out separator, columns, header and count line from the first lines. Errors: kScanFormat (no point
/// cloud, with the reason), kScanNoPoints (nothing but a header), kScanTruncated (a count line promises more
/// than can be there).
TextLayout sniff_text(const ScanBytes& file);

/// Whether a line is a comment: it begins with #, // or %.
bool is_comment_line(const char* begin, const char* end);

}  // namespace roomcut
