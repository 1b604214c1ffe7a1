// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "common/ply/ply_header.h"
#include "stages/ingest/scan_reader.h"

namespace roomcut::ingest {

/// Where x, y, z, nx, ny, nz stand among the properties of an element.
struct PlyColumns {
  std::array<std::size_t, 6> property{};
  bool normals = false;
  int count() const { return normals ? 6 : 3; }
};

/// Errors: kScanFormat when x, y or z is missing, a list, or stands twice.
PlyColumns find_columns(const PlyElement& vertex, const ScanBytes& file);

/// The i-th of x, y, z, nx, ny, nz of point `point`.
inline void store_column(ScanBlock& block, int column, std::size_t point, double value) {
  switch (column) {
    case 0:
      block.x[point] = value;
      break;
    case 1:
      block.y[point] = value;
      break;
    case 2:
      block.z[point] = value;
      break;
    case 3:
      block.nx[point] = static_cast<float>(value);
      break;
    case 4:
      block.ny[point] = static_cast<float>(value);
      break;
    default:
      block.nz[point] = static_cast<float>(value);
      break;
  }
}

}  // namespace roomcut::ingest
