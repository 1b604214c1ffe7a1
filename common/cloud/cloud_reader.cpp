// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "common/artefact/h5.h"
#include "common/cloud/cloud_io.h"
#include "common/cloud/cloud_layout.h"
#include "common/errors/codes.h"

namespace roomcut {

namespace layout = cloud_layout;

struct CloudReader::State {
  explicit State(const std::filesystem::path& path) : file(path, artefacts::kCloud) {}
  ~State() {
    if (descriptor >= 0) {
      ::close(descriptor);
    }
  }
  H5Reader file;
  CloudHeader header;
  int descriptor = -1;
  std::uint64_t x = 0, y = 0, z = 0, surface = 0, azimuth = 0,
                area = 0;  ///< where the datasets begin in the file
};

namespace {

constexpr std::uint64_t kPart = std::uint64_t{1} << 16;  ///< points: about a megabyte

Vec3 read_corner(const H5Reader& file, const char* path) {
  const std::vector<double> corner = file.read<double>(path, {3});
  return {corner[0], corner[1], corner[2]};
}

double read_number(const H5Reader& file, const char* path) {
  return file.read<double>(path, {1}).front();
}

CloudHeader read_header(const H5Reader& file) {
  CloudHeader header;
  header.frame = file.frame();
  header.points = file.shape(layout::kX)[0];
  header.bbox_min = read_corner(file, layout::kBoxMin);
  header.bbox_max = read_corner(file, layout::kBoxMax);
  header.noise_m = read_number(file, layout::kNoise);
  header.density = read_number(file, layout::kDensity);
  header.tile_edge_m = read_number(file, layout::kTileEdge);
  header.voxel_edge_m = read_number(file, layout::kVoxelEdge);
  header.tile_ix = file.read<std::int32_t>(layout::kTileIx, {0});
  header.tile_iy = file.read<std::int32_t>(layout::kTileIy, {header.tile_ix.size()});
  header.tile_offset = file.read<std::uint64_t>(layout::kTileOffset, {header.tile_ix.size() + 1});
  const std::vector<double> stations = file.read<double>(layout::kStations, {0, 3});
  for (std::size_t i = 0; i + 2 < stations.size(); i += 3) {
    header.stations.emplace_back(stations[i], stations[i + 1], stations[i + 2]);
  }
  return header;
}

void check_tiles(const H5Reader& file, const CloudHeader& header) {
  const std::vector<std::uint64_t>& offset = header.tile_offset;
  if (offset.front() != 0 || offset.back() != header.points ||
      !std::is_sorted(offset.begin(), offset.end())) {
    file.damaged(layout::kTileOffset, "does not divide the points");
  }
  for (const char* path : {layout::kY, layout::kZ, layout::kSurface, layout::kAzimuth, layout::kArea}) {
    if (file.shape(path) != h5::Shape{header.points}) {
      file.damaged(path, "has not one value per point");
    }
  }
}

}  // namespace

CloudReader::CloudReader(const std::filesystem::path& path) : state_(std::make_unique<State>(path)) {
  State& state = *state_;
  state.header = read_header(state.file);
  check_tiles(state.file, state.header);
  if (state.header.points == 0) {
    return;
  }
  state.x = state.file.contiguous_offset(layout::kX);
  state.y = state.file.contiguous_offset(layout::kY);
  state.z = state.file.contiguous_offset(layout::kZ);
  state.surface = state.file.contiguous_offset(layout::kSurface);
  state.azimuth = state.file.contiguous_offset(layout::kAzimuth);
  state.area = state.file.contiguous_offset(layout::kArea);
  state.descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (state.descriptor < 0) {
    throw StageError(errors::kArtefactMissing, path.string(), "cannot be opened", "run ingest again");
  }
}

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
  const State& state = *state_;
  const std::uint64_t first = state.header.tile_offset.at(index) + first_in_tile;
  const auto points = static_cast<std::size_t>(count);
  const auto read = [&](auto& values, std::uint64_t dataset, const char* name) {
    values.resize(points);
    const std::size_t size = sizeof(values[0]);
    std::size_t done = 0;
    while (done < points * size) {
      const ssize_t got = ::pread(state.descriptor, reinterpret_cast<char*>(values.data()) + done,
                                  points * size - done, static_cast<off_t>(dataset + first * size + done));
      if (got <= 0 && !(got < 0 && errno == EINTR)) {
        throw StageError(errors::kArtefactDamaged, state.file.path().string() + ": " + name, "cannot be read",
                         "run ingest again");
      }
      done += got > 0 ? static_cast<std::size_t>(got) : 0;
    }
  };
  read(tile.x, state.x, layout::kX);
  read(tile.y, state.y, layout::kY);
  read(tile.z, state.z, layout::kZ);
  read(tile.surface, state.surface, layout::kSurface);
  read(tile.azimuth, state.azimuth, layout::kAzimuth);
  read(tile.area, state.area, layout::kArea);
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
    for (std::uint64_t first = 0; first < points; first += kPart) {
      parts.push_back({i, first, std::min(kPart, points - first)});
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
