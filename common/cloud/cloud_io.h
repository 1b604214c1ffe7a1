// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "common/artefact/provenance.h"
#include "common/cloud/cloud.h"

namespace roomcut {

/// Reads a cloud.h5 tile by tile. Memory: one tile per thread.
class CloudReader {
 public:
  /// Checks type, version and sizes, reads the header only. Errors: kArtefact… (common/artefact/h5.h).
  explicit CloudReader(const std::filesystem::path& path);
  ~CloudReader();

  const CloudHeader& header() const;
  const std::string& payload_sha256() const;
  std::size_t tiles() const { return header().tile_ix.size(); }

  /// Reads tile `index` into `tile` (its vectors are resized, capacity is reused). Thread-safe.
  void read_tile(std::size_t index, CloudTile& tile) const;

  /// Calls visit(index, tile) once per tile, in parallel on TBB, in no particular order; results must be
  /// combined in an order-free way or by tile index. `done(points)` is called after each tile, for progress.
  /// With `densest` > 0 the visitor sees tiles thinned to that many points per square metre (thin.h).
  void for_each_tile(const std::function<void(std::size_t, const CloudTile&)>& visit,
                     const std::function<void(std::uint64_t)>& done = {}, double densest = 0) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes a cloud.h5 in one sequence of tiles: nothing is held back in memory.
class CloudWriter {
 public:
  /// Of `header`, the frame, `points` (an exact total), the tiles' ix and iy, the edges and the stations must
  /// be right. Offsets and bounding box follow from the tiles that are appended.
  CloudWriter(const std::filesystem::path& path, const Provenance& provenance, const CloudHeader& header);
  ~CloudWriter();
  /// The next tile, in the order of the header.
  void append(const CloudTile& tile);
  /// Noise and density may be set until finish().
  CloudHeader& header();
  /// Publishes; returns whether the payload is new. Throws std::logic_error when points or tiles are missing.
  bool finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roomcut
