// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

#include "common/artefact/artefact_check.h"
#include "common/cloud/cloud_header_reader.h"
#include "common/cloud/cloud_io.h"
#include "common/cloud/cloud_layout.h"

namespace roomcut {

namespace layout = cloud_layout;

struct CloudReader::State {
  explicit State(const std::filesystem::path& path)
      : file(path, artefacts::kCloud),
        header(read_cloud_header(file)),
        blocks(read_cloud_blocks(file, header)) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      columns[i] = &file.content().dataset(layout::kColumns[i]);
    }
    for (const char* path_of : {layout::kX, layout::kY, layout::kZ, layout::kArea}) {
      file.require_type<float>(path_of);
    }
    for (const char* path_of : {layout::kSurface, layout::kAzimuth}) {
      file.require_type<std::uint8_t>(path_of);
    }
  }
  H5Reader file;
  CloudHeader header;
  std::optional<h5::BlockTable> blocks;  ///< none in files of version 1.0: verified as a whole when opened
  std::array<const h5::StoredDataset*, layout::kColumns.size()> columns{};
};

namespace {

/// The least and the greatest value, NaN when one is NaN.
template <class T>
std::pair<T, T> range_of(const std::vector<T>& values) {
  const Eigen::Map<const Eigen::Array<T, Eigen::Dynamic, 1>> array(values.data(),
                                                                   static_cast<Eigen::Index>(values.size()));
  return {array.template minCoeff<Eigen::PropagateNaN>(), array.template maxCoeff<Eigen::PropagateNaN>()};
}

template <class T>
void require_range(const H5Reader& file, const char* path, const std::vector<T>& values, double low,
                   double high) {
  const auto [least, greatest] = range_of(values);
  if (!(static_cast<double>(least) >= low && static_cast<double>(greatest) <= high)) {
    file.damaged(path, "a value is not finite or out of range");
  }
}

/// Whoever has the points may index memory with them.
void check_points(const H5Reader& file, const CloudHeader& header, const CloudTile& points) {
  if (points.size() == 0) {
    return;
  }
  require_range(file, layout::kX, points.x, header.bbox_min.x(), header.bbox_max.x());
  require_range(file, layout::kY, points.y, header.bbox_min.y(), header.bbox_max.y());
  require_range(file, layout::kZ, points.z, header.bbox_min.z(), header.bbox_max.z());
  require_range(file, layout::kSurface, points.surface, 0, static_cast<double>(SurfaceClass::kSloped));
  require_range(file, layout::kArea, points.area, 0, limits::kLargestArea_m2);
}

template <class T>
void keep(std::vector<T>& values, std::uint64_t first, std::uint64_t count) {
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(first));
  values.resize(count);
}

}  // namespace

CloudReader::CloudReader(const std::filesystem::path& path) : state_(std::make_unique<State>(path)) {}

CloudReader::~CloudReader() = default;

const CloudHeader& CloudReader::header() const {
  return state_->header;
}
const std::string& CloudReader::payload_sha256() const {
  return state_->file.payload_sha256();
}

void CloudReader::read_tile(std::size_t index, CloudTile& tile) const {
  const std::vector<std::uint64_t>& offset = state_->header.tile_offset;
  read_part(index, 0, offset.at(index + 1) - offset.at(index), tile);
}

void CloudReader::read_part(std::size_t index, std::uint64_t first_in_tile, std::uint64_t count,
                            CloudTile& tile) const {
  const std::uint64_t begin = state_->header.tile_offset.at(index);
  const std::uint64_t points = state_->header.tile_offset.at(index + 1) - begin;
  if (first_in_tile > points || count > points - first_in_tile) {
    throw std::out_of_range("a tile of a cloud has fewer points");
  }
  const std::uint64_t before = first_in_tile % layout::kBlock;
  const std::uint64_t end =
      std::min(points, (first_in_tile + count + layout::kBlock - 1) / layout::kBlock * layout::kBlock);
  read_blocks(begin + first_in_tile - before, end - (first_in_tile - before), tile);
  if (tile.size() != count) {
    keep(tile.x, before, count);
    keep(tile.y, before, count);
    keep(tile.z, before, count);
    keep(tile.surface, before, count);
    keep(tile.azimuth, before, count);
    keep(tile.area, before, count);
  }
}

void CloudReader::read_blocks(std::uint64_t first, std::uint64_t count, CloudTile& tile) const {
  const State& state = *state_;
  const h5::Content& content = state.file.content();
  std::size_t first_block = 0;
  if (state.blocks) {
    const std::vector<std::uint64_t>& offset = state.blocks->offset;
    first_block =
        static_cast<std::size_t>(std::lower_bound(offset.begin(), offset.end(), first) - offset.begin());
  }
  const auto read = [&](std::size_t column, auto& values) {
    constexpr std::uint64_t kSize = sizeof(values[0]);
    const char* name = layout::kColumns[column];
    values.resize(count);
    content.read(name, *state.columns[column], first * kSize, count * kSize, values.data());
    for (std::uint64_t done = 0, b = first_block; state.blocks && done < count; done += layout::kBlock, ++b) {
      const std::uint64_t points = std::min(layout::kBlock, count - done);
      const std::uint64_t sum = h5::checksum_of(values.data() + done, points * kSize);
      if (kDigestsCount && sum != state.blocks->sum(b, column)) {
        h5::throw_damaged_block(content, name, b);
      }
    }
  };
  read(0, tile.x);
  read(1, tile.y);
  read(2, tile.z);
  read(3, tile.surface);
  read(4, tile.azimuth);
  read(5, tile.area);
  check_points(state.file, state.header, tile);
}

void CloudReader::for_each_tile(const std::function<void(std::size_t, const CloudTile&)>& visit,
                                const std::function<void(std::uint64_t)>& done) const {
  struct Part {
    std::size_t tile;
    std::uint64_t first, points;
  };
  std::vector<Part> parts;
  for (std::size_t i = 0; i < tiles(); ++i) {
    const std::uint64_t points = header().tile_offset[i + 1] - header().tile_offset[i];
    for (std::uint64_t first = 0; first < points; first += layout::kBlock) {
      parts.push_back({i, first, std::min(layout::kBlock, points - first)});
    }
  }
  tbb::enumerable_thread_specific<CloudTile> points_of_threads;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, parts.size(), 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        CloudTile& points = points_of_threads.local();
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          read_part(parts[i].tile, parts[i].first, parts[i].points, points);
          visit(parts[i].tile, points);
          if (done) {
            done(points.size());
          }
        }
      },
      tbb::simple_partitioner());
}

}  // namespace roomcut
