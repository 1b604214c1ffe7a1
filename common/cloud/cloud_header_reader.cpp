// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cloud/cloud_header_reader.h"

#include <algorithm>
#include <utility>

#include "common/cloud/cloud_layout.h"

namespace roomcut {

namespace layout = cloud_layout;

namespace {

void check_tiles(const H5Reader& file, const CloudHeader& header) {
  const std::vector<std::uint64_t>& offset = header.tile_offset;
  if (offset.front() != 0 || offset.back() != header.points ||
      !std::is_sorted(offset.begin(), offset.end())) {
    file.damaged(layout::kTileOffset, "does not divide the points");
  }
  for (std::size_t i = 1; i < header.tile_ix.size(); ++i) {
    if (std::pair(header.tile_iy[i], header.tile_ix[i]) <=
        std::pair(header.tile_iy[i - 1], header.tile_ix[i - 1])) {
      file.damaged(layout::kTileIy, "the tiles are not sorted by (iy, ix)");
    }
  }
  const double farthest = limits::kFarthest_m / header.tile_edge_m;
  check_range(file, layout::kTileIx, header.tile_ix, -farthest, farthest);
  check_range(file, layout::kTileIy, header.tile_iy, -farthest, farthest);
  for (const char* path : layout::kColumns) {
    if (file.shape(path) != h5::Shape{header.points}) {
      file.damaged(path, "has not one value per point");
    }
  }
}

/// Where blocks begin that begin and end with tiles.
std::vector<std::uint64_t> blocks_of(const CloudHeader& header) {
  std::vector<std::uint64_t> offset{0};
  for (std::size_t i = 0; i + 1 < header.tile_offset.size(); ++i) {
    while (offset.back() < header.tile_offset[i + 1]) {
      offset.push_back(std::min(offset.back() + layout::kBlock, header.tile_offset[i + 1]));
    }
  }
  return offset;
}

}  // namespace

CloudHeader read_cloud_header(const H5Reader& file) {
  using namespace limits;
  CloudHeader header;
  header.frame = file.frame();
  header.points = file.shape(layout::kX)[0];
  read_box(file, layout::kBoxMin, layout::kBoxMax, header.bbox_min, header.bbox_max);
  header.noise_m = read_number(file, layout::kNoise, 0, kLargestNoise_m);
  header.density = read_number(file, layout::kDensity, 0, kDensest);
  header.tile_edge_m = read_number(file, layout::kTileEdge, kSmallestEdge_m, kLargestEdge_m);
  header.voxel_edge_m = read_number(file, layout::kVoxelEdge, kSmallestEdge_m, kLargestEdge_m);
  header.tile_ix = file.read<std::int32_t>(layout::kTileIx, {0});
  header.tile_iy = file.read<std::int32_t>(layout::kTileIy, {header.tile_ix.size()});
  header.tile_offset = file.read<std::uint64_t>(layout::kTileOffset, {header.tile_ix.size() + 1});
  const auto stations =
      read_in_range<double>(file, layout::kStations, {0, 3}, -kFarthestOrigin_m, kFarthestOrigin_m);
  for (std::size_t i = 0; i + 2 < stations.size(); i += 3) {
    header.stations.emplace_back(stations[i], stations[i + 1], stations[i + 2]);
  }
  check_tiles(file, header);
  return header;
}

std::optional<h5::BlockTable> read_cloud_blocks(const H5Reader& file, const CloudHeader& header) {
  if (!file.exists(layout::kChecksum)) {
    return std::nullopt;
  }
  h5::BlockTable table = h5::read_blocks(file.content(), layout::kPoints);
  if (table.offset != blocks_of(header) || table.columns != layout::kColumns.size()) {
    file.damaged(layout::kBlockOffset, "the blocks do not divide the tiles");
  }
  for (std::size_t column = 0; column < layout::kColumns.size(); ++column) {
    if (file.attribute_int(layout::kColumns[column], h5::kChecksumColumn) !=
        static_cast<std::int64_t>(column)) {
      file.damaged(layout::kColumns[column], "names another column of checksums");
    }
  }
  return table;
}

}  // namespace roomcut
