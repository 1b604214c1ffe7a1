// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/tile_store.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "common/errors/codes.h"

namespace roomcut {

namespace {

[[noreturn]] void scratch_failed(const std::filesystem::path& folder) {
  const std::string reason = std::generic_category().message(errno);
  throw StageError(errors::kCannotWrite, folder.string(),
                   "the scratch file for points cannot be written: " + reason,
                   "free some space there (12 bytes per point), or raise --memory-mib");
}

int make_scratch_file(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::string name = (folder / ".ingest.XXXXXX").string();
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor >= 0) {
    ::unlink(name.c_str());  // it goes with the process, however that ends
  }
  return descriptor;
}

}  // namespace

TileStore::TileStore(std::filesystem::path folder, std::size_t blocks, std::uint64_t memory_bytes, bool hints)
    : folder_(std::move(folder)), blocks_(blocks), budget_(memory_bytes), hints_(hints) {}

TileStore::~TileStore() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

void TileStore::spill(SortedBlock& block) {
  std::call_once(file_made_, [&] { descriptor_ = make_scratch_file(folder_); });
  if (descriptor_ < 0) {
    scratch_failed(folder_);
  }
  block.file_offset = file_end_.fetch_add(block.size);
  std::uint64_t done = 0;
  while (done < block.size) {
    const ssize_t wrote = ::pwrite(descriptor_, block.bytes.get() + done, block.size - done,
                                   static_cast<off_t>(block.file_offset + done));
    if (wrote < 0 && errno == EINTR) {
      continue;
    }
    if (wrote <= 0) {
      scratch_failed(folder_);
    }
    done += static_cast<std::uint64_t>(wrote);
  }
  block.bytes.reset();
}

void TileStore::put(std::size_t index, SortedBlock&& block) {
  if (held_.fetch_add(block.size) + block.size > budget_) {
    held_ -= block.size;
    spill(block);
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

void TileStore::gather(std::uint32_t tile, TilePoints& points) const {
  const auto first =
      std::lower_bound(runs_.begin(), runs_.end(), tile,
                       [](const RunRef& run, std::uint32_t wanted) { return run.tile < wanted; });
  std::size_t total = 0;
  for (auto run = first; run != runs_.end() && run->tile == tile; ++run) {
    total += run->points;
  }
  for (std::vector<float>* axis : {&points.x, &points.y, &points.z}) {
    axis->resize(total);
  }
  points.hint.resize(hints_ ? total : 0);
  std::vector<std::byte> loaded;
  std::size_t at = 0;
  for (auto run = first; run != runs_.end() && run->tile == tile; ++run) {
    const SortedBlock& block = blocks_[run->block];
    const std::byte* bytes = block.bytes.get() + run->offset;
    if (block.bytes == nullptr) {
      loaded.resize(run->points * std::size_t{hints_ ? 14U : 12U});
      const ssize_t got = ::pread(descriptor_, loaded.data(), loaded.size(),
                                  static_cast<off_t>(block.file_offset + run->offset));
      if (got != static_cast<ssize_t>(loaded.size())) {
        scratch_failed(folder_);
      }
      bytes = loaded.data();
    }
    const std::size_t part = run->points * sizeof(float);
    std::memcpy(points.x.data() + at, bytes, part);
    std::memcpy(points.y.data() + at, bytes + part, part);
    std::memcpy(points.z.data() + at, bytes + 2 * part, part);
    if (hints_) {
      std::memcpy(points.hint.data() + at, bytes + 3 * part, run->points * sizeof(std::uint16_t));
    }
    at += run->points;
  }
}

}  // namespace roomcut
