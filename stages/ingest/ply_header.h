// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stages/ingest/scalar_type.h"
#include "stages/ingest/scan_bytes.h"

namespace roomcut::ingest {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::kFloat32;
  bool is_list = false;
  ScalarType count_type = ScalarType::kUint8;  ///< lists only
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as promised
  std::vector<PlyProperty> properties;
  bool has_list() const;
  /// Bytes of one binary record with every list empty: exact without lists, a lower bound with them.
  std::uint64_t smallest_record() const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;
  std::uint64_t data_offset = 0;  ///< first byte after the header
  std::size_t lines = 0;          ///< header lines, for line numbers of an ascii body
  std::size_t vertex = 0;         ///< index of the vertex element
};

/// Reads the header. Errors: kScanFormat (with the header line), kScanTruncated (no end_header).
PlyHeader read_ply_header(const ScanBytes& file);

}  // namespace roomcut::ingest
