// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <stdexcept>

#include "common/artefact/h5.h"
#include "common/artefact/h5_blocks.h"
#include "common/cloud/cloud_io.h"
#include "common/cloud/cloud_layout.h"

namespace roomcut {

namespace layout = cloud_layout;

namespace {

/// The checksums of the blocks, made as the points come.
class BlockSums {
 public:
  void add(const CloudTile& part) {
    for (std::size_t first = 0; first < part.size();) {
      const std::size_t count =
          std::min(part.size() - first, static_cast<std::size_t>(layout::kBlock - open_));
      const auto update = [&](std::size_t column, const auto& values) {
        columns_[column].update(values.data() + first, count * sizeof(values[0]));
      };
      update(0, part.x);
      update(1, part.y);
      update(2, part.z);
      update(3, part.surface);
      update(4, part.azimuth);
      update(5, part.area);
      first += count;
      open_ += count;
      if (open_ == layout::kBlock) {
        close();
      }
    }
  }
  /// Ends the block that has begun, if one has.
  void close() {
    if (open_ > 0) {
      for (h5::Checksum& column : columns_) {
        sums_.push_back(column.take());
      }
      offset_.push_back(offset_.back() + open_);
      open_ = 0;
    }
  }
  const std::vector<std::uint64_t>& offset() const { return offset_; }
  const std::vector<std::uint64_t>& sums() const { return sums_; }

 private:
  std::array<h5::Checksum, layout::kColumns.size()> columns_;
  std::uint64_t open_ = 0;  ///< points of the block that has begun
  std::vector<std::uint64_t> offset_{0};
  std::vector<std::uint64_t> sums_;
};

}  // namespace

struct CloudWriter::State {
  State(const std::filesystem::path& path, const Provenance& provenance, const CloudHeader& from)
      : file(path, artefacts::kCloud, provenance, from.frame), header(from) {}
  H5Writer file;
  CloudHeader header;
  std::uint64_t points = 0;  ///< appended so far
  BlockSums sums;
  std::array<float, 3> low{}, high{};
};

namespace {

void write_number(H5Writer& file, const char* path, double value, const char* unit, const char* description) {
  file.write(path, std::vector<double>{value}, unit, description);
}

void write_corner(H5Writer& file, const char* path, const Vec3& corner, const char* description) {
  file.write(path, std::vector<double>{corner.x(), corner.y(), corner.z()}, "m", description);
}

void widen(const std::vector<float>& values, float& low, float& high) {
  for (const float value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
}

Vec3 as_point(const std::array<float, 3>& corner) {
  return {corner[0], corner[1], corner[2]};
}

}  // namespace

CloudWriter::CloudWriter(const std::filesystem::path& path, const Provenance& provenance,
                         const CloudHeader& header)
    : state_(std::make_unique<State>(path, provenance, header)) {
  state_->header.tile_offset = {0};
  state_->low.fill(std::numeric_limits<float>::max());
  state_->high.fill(std::numeric_limits<float>::lowest());
  const h5::Shape shape{header.points};
  H5Writer& file = state_->file;
  file.begin<float>(layout::kX, shape, "m", "coordinate, local frame", 0);
  file.begin<float>(layout::kY, shape, "m", "coordinate, local frame", 1);
  file.begin<float>(layout::kZ, shape, "m", "height, local frame", 2);
  file.begin<std::uint8_t>(layout::kSurface, shape, "1", "class: 0 none, 1 horizontal, 2 wall, 3 sloped", 3);
  file.begin<std::uint8_t>(
      layout::kAzimuth, shape, "1",
      "direction of a wall's normal: theta = (value + 1/2) * pi / 256; 0 for other classes", 4);
  file.begin<float>(layout::kArea, shape, "m^2", "surface area that the point stands for", 5);
}

CloudWriter::~CloudWriter() = default;

void CloudWriter::append(const CloudTile& part, bool complete) {
  H5Writer& file = state_->file;
  file.append(layout::kX, std::span<const float>(part.x));
  file.append(layout::kY, std::span<const float>(part.y));
  file.append(layout::kZ, std::span<const float>(part.z));
  file.append(layout::kSurface, std::span<const std::uint8_t>(part.surface));
  file.append(layout::kAzimuth, std::span<const std::uint8_t>(part.azimuth));
  file.append(layout::kArea, std::span<const float>(part.area));
  widen(part.x, state_->low[0], state_->high[0]);
  widen(part.y, state_->low[1], state_->high[1]);
  widen(part.z, state_->low[2], state_->high[2]);
  state_->points += part.size();
  state_->sums.add(part);
  if (complete) {
    state_->sums.close();
    state_->header.tile_offset.push_back(state_->points);
  }
}

CloudHeader& CloudWriter::header() {
  return state_->header;
}

bool CloudWriter::finish() {
  CloudHeader& header = state_->header;
  const std::size_t tiles = header.tile_ix.size();
  if (header.tile_offset.size() != tiles + 1 || header.tile_iy.size() != tiles ||
      header.tile_offset.back() != header.points) {
    throw std::logic_error("a cloud's tiles or points are not those its header promises");
  }
  if (header.points > 0) {
    header.bbox_min = as_point(state_->low);
    header.bbox_max = as_point(state_->high);
  }
  H5Writer& file = state_->file;
  const BlockSums& sums = state_->sums;
  file.write(layout::kBlockOffset, sums.offset(), "1", "first point of each block, and the total");
  file.write(layout::kChecksum, std::span<const std::uint64_t>(sums.sums()),
             {sums.offset().size() - 1, layout::kColumns.size()}, "1",
             "XXH3 of the bytes of each block in x, y, z, surface, azimuth, area");
  file.write(layout::kTileIx, header.tile_ix, "1", "tile i covers [ix, ix + 1) edges in x");
  file.write(layout::kTileIy, header.tile_iy, "1", "and [iy, iy + 1) edges in y; sorted by (iy, ix)");
  file.write(layout::kTileOffset, header.tile_offset, "1", "first point of each tile, and the total");
  write_number(file, layout::kTileEdge, header.tile_edge_m, "m", "edge of a tile");
  write_number(file, layout::kVoxelEdge, header.voxel_edge_m, "m", "edge of the finest voxel");
  write_corner(file, layout::kBoxMin, header.bbox_min, "lower corner of the points' box, local frame");
  write_corner(file, layout::kBoxMax, header.bbox_max, "upper corner of the points' box, local frame");
  write_number(file, layout::kNoise, header.noise_m, "m",
               "standard deviation of points off their plane, median");
  write_number(file, layout::kDensity, header.density, "1/m^2", "points per area of surface, median");
  std::vector<double> stations;
  for (const Vec3& station : header.stations) {
    stations.insert(stations.end(), {station.x(), station.y(), station.z()});
  }
  file.write(layout::kStations, std::span<const double>(stations), {header.stations.size(), 3}, "m",
             "scanner positions, local frame");
  return file.commit();
}

}  // namespace roomcut
