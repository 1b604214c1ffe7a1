// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_reader.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "common/errors/codes.h"
#include "stages/ingest/decoded_scan.h"
#include "stages/ingest/pcd_header.h"
#include "stages/ingest/scan_pcd.h"
#include "stages/ingest/scan_ply.h"
#include "stages/ingest/scan_ptx.h"
#include "stages/ingest/scan_text.h"
#include "stages/ingest/text_bytes.h"

namespace roomcut::ingest {

namespace {

struct ForeignFormat {
  std::string_view magic;
  const char* name;
};

constexpr std::array<ForeignFormat, 5> kForeign{{{"\x89HDF", "an HDF5 file"},
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

void ScanBlock::drop_no_returns() {
  const auto is_none = [this](std::size_t i) { return x[i] == 0 && y[i] == 0 && z[i] == 0; };
  std::size_t kept = 0;
  while (kept < size() && !is_none(kept)) {
    ++kept;
  }
  for (std::size_t i = kept; i < size(); ++i) {
    if (is_none(i)) {
      continue;
    }
    for (std::vector<double>* axis : {&x, &y, &z}) {
      (*axis)[kept] = (*axis)[i];
    }
    for (std::vector<float>* axis : {&nx, &ny, &nz}) {
      if (!axis->empty()) {
        (*axis)[kept] = (*axis)[i];
      }
    }
    ++kept;
  }
  no_returns += size() - kept;
  resize(kept, !nx.empty());
}

namespace {

std::unique_ptr<ScanReader> open_known(const std::shared_ptr<const ScanFile>& file,
                                       const ScanOptions& options) {
  const auto text = std::make_shared<const TextBytes>(file);
  std::array<char, 16> bytes{};
  const std::string_view head(bytes.data(), text->read(0, bytes.data(), bytes.size()));
  if (is_ply(head)) {
    return open_ply(file, text);
  }
  if (const char* decoder = decoder_of(head)) {
    return open_decoded(*file, decoder, options);
  }
  for (const ForeignFormat& foreign : kForeign) {
    if (head.starts_with(foreign.magic)) {
      throw StageError(errors::kScanFormat, file->name(), std::string("this is ") + foreign.name,
                       "convert it to PLY or text, e.g. with CloudCompare or PDAL");
    }
  }
  if (is_pcd(*text)) {
    return open_pcd(file, text, options.scratch_folder);
  }
  if (is_ptx(*text)) {
    return open_ptx(text);
  }
  return nullptr;
}

}  // namespace

std::unique_ptr<ScanReader> open_scan(const std::filesystem::path& path, const ScanOptions& options) {
  const auto file = std::make_shared<const ScanFile>(path);
  std::unique_ptr<ScanReader> reader = open_known(file, options);
  if (!reader) {
    return open_text(std::make_shared<const TextBytes>(file), options.columns);
  }
  if (!options.columns.empty()) {
    reader->warn(
        "--columns is for text without a header of its own; this file says itself what its columns are");
  }
  return reader;
}

}  // namespace roomcut::ingest
