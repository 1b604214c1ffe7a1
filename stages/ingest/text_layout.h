// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stages/ingest/scan_bytes.h"
#include "stages/ingest/text_dialect.h"

namespace roomcut::ingest {

/// What one line of a text cloud consists of.
struct TextLayout {
  static constexpr int kSkip = -1;  ///< a field that is not used
  static constexpr int kList = -2;  ///< a count and as many numbers (ascii PLY)

  TextDialect dialect;
  std::vector<int>
      fields;  ///< per field up to the last used one: kSkip, kList or 0 … 5 for x, y, z, nx, ny, nz
  bool normals = false;
  std::uint64_t begin = 0;                ///< first byte that may belong to a point
  std::uint64_t end = 0;                  ///< byte after the last
  std::optional<std::uint64_t> promised;  ///< points that a count line promises (.pts)
  std::string description;                ///< for the user: which columns are x, y, z, and why
};

/// Finds out dialect, columns, header and count line from the first lines; `given`: the columns that the user
/// names (text_columns.h), or none. Errors: kScanFormat (no point cloud, with the reason), kScanColumns (it
/// is not certain what the columns are), kScanNoPoints (nothing but a header), kScanTruncated (a count line
/// promises more than can be there).
TextLayout sniff_text(const ScanBytes& text, const std::vector<int>& given = {});

/// Whether a line is a comment: it begins with #, // or %.
bool is_comment_line(const char* begin, const char* end);

}  // namespace roomcut::ingest
