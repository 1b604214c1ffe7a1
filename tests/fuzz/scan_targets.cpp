// SPDX-License-Identifier: GPL-3.0-or-later
// Scans, and the scanner positions beside them.
#include <array>

#include "stages/ingest/ingest.h"
#include "stages/ingest/scan_reader.h"
#include "stages/ingest/scan_stations.h"
#include "tests/fuzz/target.h"

namespace roomcut::fuzz {
using namespace roomcut::ingest;

namespace {

/// All that ingest does with a file: reads it, sorts the points into tiles, classes them.
void ingest(std::string_view bytes, std::string_view ending) {
  const PrivateFile file(bytes, ending);
  const auto reader = open_scan(file.path(), {{}, private_folder()});
  const IngestParams params;
  ScanSettings settings;
  settings.memory_bytes = std::uint64_t{1} << 20;
  settings.scratch_folder = private_folder();
  settings.name = file.path().string();
  const TiledScan scan = tile_scan(*reader, settings, params);
  class_tiles(scan, params, [](const CloudTile&, bool) {});
}

void scan_ply(std::string_view bytes) {
  if (bytes.starts_with("ply")) {
    ingest(bytes, ".ply");
  }
}

/// Whatever it is: text, PTX, PTS, PCD are told apart by their content.
void scan_text(std::string_view bytes) {
  if (!bytes.starts_with("ply")) {
    ingest(bytes, ".xyz");
  }
}
void scan_pcd(std::string_view bytes) {
  ingest(bytes, ".pcd");
}
void scan_ptx(std::string_view bytes) {
  ingest(bytes, ".ptx");
}

void stations(std::string_view bytes) {
  const PrivateFile file(bytes, ".txt");
  read_stations(file.path());
}

constexpr std::array kTargets{
    Target{"scan_ply", Mutation::kBytes, scan_ply, ""}, Target{"scan_text", Mutation::kBytes, scan_text, ""},
    Target{"scan_pcd", Mutation::kBytes, scan_pcd, ""}, Target{"scan_ptx", Mutation::kBytes, scan_ptx, ""},
    Target{"stations", Mutation::kBytes, stations, ""}};

}  // namespace

std::span<const Target> scan_targets() {
  return kTargets;
}

}  // namespace roomcut::fuzz
