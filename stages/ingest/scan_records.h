// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>

#include "common/ply/scalar_type.h"
#include "stages/ingest/scan_reader.h"

namespace roomcut::ingest {

/// Where the numbers of one column stand.
struct RecordColumn {
  std::uint64_t offset = 0;  ///< of the first point's number
  std::size_t stride = 0;    ///< bytes to the next point's
  ScalarType type = ScalarType::kFloat32;
};

/// Points in binary records of one size, or in whole columns one after the other.
struct RecordLayout {
  std::uint64_t count = 0;                ///< of points; all of them must be there
  std::array<RecordColumn, 6> columns{};  ///< x, y, z, nx, ny, nz
  bool normals = false;
  bool swap = false;  ///< the other byte order
};

/// Blocks of 65,536 points of such a layout in `bytes`.
std::unique_ptr<ScanReader> record_reader(const std::shared_ptr<const ScanBytes>& bytes,
                                          const RecordLayout& layout, const std::vector<Vec3>& stations);

/// The distance from `magnitude` to the next number of a type; 0 for doubles and integers.
double spacing_of(ScalarType type, double magnitude);

}  // namespace roomcut::ingest
