// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_reader.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "common/errors/codes.h"
#include "stages/ingest/scan_ply.h"
#include "stages/ingest/scan_text.h"

namespace roomcut {

namespace {

struct ForeignFormat {
  std::string_view magic;
  const char* name;
};

constexpr std::array<ForeignFormat, 8> kForeign{{{"LASF", "a LAS/LAZ file"},
                                                 {"ASTM-E57", "an E57 file"},
                                                 {"# .PCD", "a PCD file"},
                                                 {"\x89HDF", "an HDF5 file"},
                                                 {"PK\x03\x04", "a ZIP archive"},
                                                 {"\x1f\x8b", "a gzip archive"},
                                                 {"OFF", "an OFF mesh"},
                                                 {"solid ", "an STL mesh"}}};

bool is_ply(std::string_view head) {
  return head == "ply" || head.starts_with("ply\n") || head.starts_with("ply\r");
}

}  // namespace

void ScanBlock::resize(std::size_t points, bool normals) {
  for (std::vector<double>* axis : {&x, &y, &z}) {
    axis->resize(points);
  }
  for (std::vector<float>* axis : {&nx, &ny, &nz}) {
    axis->resize(normals ? points : 0);
  }
}

std::unique_ptr<ScanReader> open_scan(const std::filesystem::path& path) {
  auto file = std::make_shared<const ScanFile>(path);
  std::array<char, 16> bytes{};
  const std::string_view head(bytes.data(), file->read(0, bytes.data(), bytes.size()));
  if (is_ply(head)) {
    return open_ply(file);
  }
  for (const ForeignFormat& foreign : kForeign) {
    if (head.starts_with(foreign.magic)) {
      throw StageError(errors::kScanFormat, file->name(), std::string("this is ") + foreign.name,
                       "convert it to PLY or text, e.g. with CloudCompare or PDAL");
    }
  }
  return open_text(file);
}

}  // namespace roomcut
