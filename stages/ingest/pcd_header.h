// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "stages/ingest/scan_bytes.h"

namespace roomcut::ingest {

enum class PcdData { kAscii, kBinary, kCompressed };

struct PcdField {
  std::string name;
  char type = 'F';          ///< F, I or U
  std::uint64_t size = 4;   ///< bytes of one number: 1, 2, 4 or 8
  std::uint64_t count = 1;  ///< numbers of it in a point
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t points = 0;                              ///< as promised
  std::array<double, 7> viewpoint{0, 0, 0, 1, 0, 0, 0};  ///< translation, quaternion w x y z
  PcdData data = PcdData::kAscii;
  std::uint64_t data_offset = 0;       ///< first byte after the header
  std::uint64_t record_bytes() const;  ///< of one binary point
};

/// Whether the file is a PCD: it begins with a comment that says so, or a line of FIELDS and one of DATA
/// stand among the first. The format asks for no comment and no order.
bool is_pcd(const ScanBytes& text);

/// Reads the header, whatever the order of its lines before DATA. Errors: kScanFormat (with the header line),
/// kScanTruncated (no DATA).
PcdHeader read_pcd_header(const ScanBytes& text);

}  // namespace roomcut::ingest
