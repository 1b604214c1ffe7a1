// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "common/artefact/provenance.h"
#include "common/cloud/cloud.h"

namespace roomcut {

/// Reads a cloud.h5 tile by tile, or tiles by parts. Memory: one tile, or part, per thread. Points are
/// checked as they are read: against the checksum of their block, finite, and in the scan's box;
/// kArtefactDamaged.
class CloudReader {
 public:
  /// Checks type, version and sizes, reads the header only (of a cloud of version 1.0, which has no
  /// checksums, everything). Errors: kArtefact… (common/artefact/h5.h).
  explicit CloudReader(const std::filesystem::path& path);
  ~CloudReader();

  const CloudHeader& header() const;
  const std::string& payload_sha256() const;
  std::size_t tiles() const { return header().tile_ix.size(); }

  /// Reads tile `index` into `tile` (its vectors are resized, capacity is reused). Thread-safe.
  void read_tile(std::size_t index, CloudTile& tile) const;

  /// Points [first_in_tile, first_in_tile + count) of a tile. Likewise. Whole blocks are read: cheapest when
  /// the part begins and ends with blocks of 65,536.
  void read_part(std::size_t index, std::uint64_t first_in_tile, std::uint64_t count, CloudTile& tile) const;

  /// Calls visit(index, points) for each tile, in parallel on TBB, in no particular order, and several times
  /// for one with many points, each time with a part of it that fits into the processor's cache: so memory
  /// does not grow with the density of a scan. Results must be combined in an order-free way. `done(points)`
  /// is called after each call, for progress.
  void for_each_tile(const std::function<void(std::size_t, const CloudTile&)>& visit,
                     const std::function<void(std::uint64_t)>& done = {}) const;

 private:
  struct State;
  void read_blocks(std::uint64_t first, std::uint64_t count, CloudTile& tile) const;
  std::unique_ptr<State> state_;
};

/// Writes a cloud.h5 in one sequence of tiles: nothing is held back in memory.
class CloudWriter {
 public:
  /// Of `header`, the frame, `points` (an exact total), the tiles' ix and iy, the edges and the stations must
  /// be right. Offsets and bounding box follow from the tiles that are appended.
  CloudWriter(const std::filesystem::path& path, const Provenance& provenance, const CloudHeader& header);
  ~CloudWriter();
  /// The next tile, in the order of the header; or a part of it, all but the last with `complete` false.
  void append(const CloudTile& part, bool complete = true);
  /// Noise and density may be set until finish().
  CloudHeader& header();
  /// Publishes; returns whether the payload is new. Throws std::logic_error when points or tiles are missing.
  bool finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roomcut
