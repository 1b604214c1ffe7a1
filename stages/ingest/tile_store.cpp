// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/tile_store.h"

#include <algorithm>
#include <cstring>

namespace roomcut::ingest {

TileStore::TileStore(std::filesystem::path folder, std::size_t blocks, std::uint64_t memory_bytes, bool hints)
    : blocks_(blocks), budget_(memory_bytes), scratch_(std::move(folder)), hints_(hints) {}

void TileStore::put(std::size_t index, SortedBlock&& block) {
  if (held_.fetch_add(block.size) + block.size > budget_) {
    held_ -= block.size;
    block.file_offset = file_end_.fetch_add(block.size);
    scratch_.write(block.file_offset, {block.bytes.get(), block.size});
    block.bytes.reset();
  }
  blocks_[index] = std::move(block);
}

std::vector<CellCount> TileStore::index_tiles() {
  std::vector<CellCount> cells;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    SortedBlock& block = blocks_[i];
    for (const SortedBlock::Run& run : block.runs) {
      runs_.push_back({run.tile, static_cast<std::uint32_t>(i), run.points, run.offset});
    }
    cells.insert(cells.end(), block.cells.begin(), block.cells.end());
    std::vector<SortedBlock::Run>().swap(block.runs);
    std::vector<CellCount>().swap(block.cells);
  }
  std::stable_sort(runs_.begin(), runs_.end(),
                   [](const RunRef& a, const RunRef& b) { return a.tile < b.tile; });
  return cells;
}

std::vector<TileStore::RunRef>::const_iterator TileStore::first_run(std::uint32_t tile) const {
  return std::lower_bound(runs_.begin(), runs_.end(), tile,
                          [](const RunRef& run, std::uint32_t wanted) { return run.tile < wanted; });
}

void TileStore::for_runs(std::uint32_t tile, const VisitRun& visit) const {
  std::vector<std::byte> loaded;
  for (auto run = first_run(tile); run != runs_.end() && run->tile == tile; ++run) {
    const SortedBlock& block = blocks_[run->block];
    const std::byte* bytes = block.bytes.get() + run->offset;
    if (block.bytes == nullptr) {
      loaded.resize(run->points * std::size_t{hints_ ? 14U : 12U});
      scratch_.read(block.file_offset + run->offset, loaded);
      bytes = loaded.data();
    }
    const std::size_t n = run->points;
    const auto* x = reinterpret_cast<const float*>(bytes);
    const auto* hint = reinterpret_cast<const std::uint16_t*>(x + 3 * n);
    visit({x, x + n, x + 2 * n, hints_ ? hint : nullptr, n});
  }
}

void TileStore::gather(std::uint32_t tile, TilePoints& loaded, TileRuns& runs) const {
  runs.clear();
  std::size_t total = 0;
  bool in_memory = true;
  for (auto run = first_run(tile); run != runs_.end() && run->tile == tile; ++run) {
    total += run->points;
    in_memory = in_memory && blocks_[run->block].bytes != nullptr;
  }
  if (in_memory) {
    for_runs(tile, [&](const TileRun& run) { runs.push_back(run); });
    return;
  }
  loaded.resize(total, hints_);
  std::size_t at = 0;
  for_runs(tile, [&](const TileRun& run) {
    std::memcpy(loaded.x.data() + at, run.x, run.points * sizeof(float));
    std::memcpy(loaded.y.data() + at, run.y, run.points * sizeof(float));
    std::memcpy(loaded.z.data() + at, run.z, run.points * sizeof(float));
    if (hints_) {
      std::memcpy(loaded.hint.data() + at, run.hint, run.points * sizeof(std::uint16_t));
    }
    at += run.points;
  });
  runs.push_back(run_of(loaded));
}

}  // namespace roomcut::ingest
