// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "common/artefact/provenance.h"
#include "stages/tools/synthesize/scan_writer.h"
#include "stages/tools/synthesize/truth.h"

namespace roomcut::synthesize {

/// Writes the scan in the format of its name (scan_writer.h) while it is made: blocks are made in parallel
/// and written in order, a few of them in memory at a time. Returns the number of points. Throws
/// StageError(kCannotWrite), and what make_scan_writer() throws.
std::uint64_t write_scan(const std::filesystem::path& path, const Scene& scene, const PointSource& source,
                         const ScanFormat& format, int threads,
                         const std::function<void(std::uint64_t)>& progress);

/// Writes the truth with all copies of the building as OFF. Throws StageError(kCannotWrite).
void write_truth(const std::filesystem::path& path, const Scene& scene, const Building& building,
                 const TriangleMesh& truth);

/// The content of truth.json (schemas/truth.md).
nlohmann::json truth_json(const Scene& scene, const Building& building, const TriangleMesh& truth,
                          std::uint64_t points);
void write_truth_json(const std::filesystem::path& path, const Scene& scene, const Building& building,
                      const TriangleMesh& truth, std::uint64_t points, const Provenance& provenance);

}  // namespace roomcut::synthesize
