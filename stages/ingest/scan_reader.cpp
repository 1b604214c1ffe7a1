// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_reader.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "common/errors/codes.h"
#include "stages/ingest/pcd_header.h"
#include "stages/ingest/scan_ply.h"
#include "stages/ingest/scan_text.h"
#include "stages/ingest/text_bytes.h"

namespace roomcut {

namespace {

struct ForeignFormat {
  std::string_view magic;
  const char* name;
};

constexpr const char* kConvert = "convert it to PLY or text, e.g. with CloudCompare or PDAL";
constexpr std::array<ForeignFormat, 7> kForeign{{{"LASF", "a LAS/LAZ file"},
                                                 {"ASTM-E57", "an E57 file"},
                                                 {"\x89HDF", "an HDF5 file"},
                                                 {"PK\x03\x04", "a ZIP archive"},
                                                 {"\x1f\x8b", "a gzip archive"},
                                                 {"OFF", "an OFF mesh"},
                                                 {"solid ", "an STL mesh"}}};

}  // namespace

void ScanBlock::resize(std::size_t points, bool normals) {
  for (std::vector<double>* axis : {&x, &y, &z}) {
    axis->resize(points);
  }
  for (std::vector<float>* axis : {&nx, &ny, &nz}) {
    axis->resize(normals ? points : 0);
  }
}

std::unique_ptr<ScanReader> open_scan(const std::filesystem::path& path, const std::vector<int>& columns) {
  auto file = std::make_shared<const ScanFile>(path);
  auto text = std::make_shared<const TextBytes>(file);
  std::array<char, 16> bytes{};
  const std::string_view head(bytes.data(), text->read(0, bytes.data(), bytes.size()));
  if (is_ply(head)) {
    std::unique_ptr<ScanReader> reader = open_ply(file, text);
    if (!columns.empty()) {
      reader->warn("--columns is for text; this is a PLY, whose header names its columns");
    }
    return reader;
  }
  if (is_pcd(*text)) {
    throw StageError(errors::kScanFormat, file->name(), "this is a PCD file", kConvert);
  }
  for (const ForeignFormat& foreign : kForeign) {
    if (head.starts_with(foreign.magic)) {
      throw StageError(errors::kScanFormat, file->name(), std::string("this is ") + foreign.name, kConvert);
    }
  }
  return open_text(text, columns);
}

}  // namespace roomcut
