// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/ply_columns.h"

#include <string>

#include "common/errors/codes.h"

namespace roomcut::ingest {

namespace {

constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);

std::size_t find_property(const PlyElement& vertex, const std::string& name, const ScanBytes& file) {
  std::size_t found = kAbsent;
  for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
    const PlyProperty& property = vertex.properties[i];
    if (property.name != name || property.is_list) {
      continue;
    }
    if (found != kAbsent) {
      throw StageError(errors::kScanFormat, file.name(), "the property '" + name + "' of vertex stands twice",
                       "remove one of the two");
    }
    found = i;
  }
  return found;
}

}  // namespace

PlyColumns find_columns(const PlyElement& vertex, const ScanBytes& file) {
  PlyColumns columns;
  constexpr std::array<const char*, 6> kNames{"x", "y", "z", "nx", "ny", "nz"};
  columns.normals = true;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    columns.property[i] = find_property(vertex, kNames[i], file);
    if (columns.property[i] != kAbsent) {
      continue;
    }
    if (i < 3) {
      throw StageError(errors::kScanFormat, file.name(),
                       std::string("vertex has no property '") + kNames[i] + "'",
                       "the coordinates must be called x, y and z");
    }
    columns.normals = false;
  }
  return columns;
}

}  // namespace roomcut::ingest
