// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_records.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roomcut::ingest {

namespace {

constexpr std::uint64_t kPointsPerBlock = 1 << 16;

class RecordReader : public ScanReader {
 public:
  RecordReader(std::shared_ptr<const ScanBytes> bytes, const RecordLayout& layout, std::vector<Vec3> stations)
      : bytes_(std::move(bytes)), layout_(layout), stations_(std::move(stations)) {
    first_ = last_ = layout_.columns[0].offset;
    for (std::size_t i = 0; i < columns(); ++i) {
      const RecordColumn& column = layout_.columns[i];
      first_ = std::min(first_, column.offset);
      last_ = std::max(last_, column.offset + bytes_of(column.type));
      together_ = together_ && column.stride == layout_.columns[0].stride;
    }
    together_ = together_ && last_ - first_ <= layout_.columns[0].stride;
  }

  std::size_t blocks() const override {
    return static_cast<std::size_t>((layout_.count + kPointsPerBlock - 1) / kPointsPerBlock);
  }
  bool has_normals() const override { return layout_.normals; }
  const std::vector<Vec3>& stations() const override { return stations_; }
  double resolution(double magnitude) const override {
    return spacing_of(layout_.columns[0].type, magnitude);
  }

  void read(std::size_t index, ScanBlock& block) const override {
    thread_local std::vector<unsigned char> held;
    const std::uint64_t begin = index * kPointsPerBlock;
    const auto points = static_cast<std::size_t>(std::min(kPointsPerBlock, layout_.count - begin));
    block.resize(points, layout_.normals);
    if (together_) {
      load(first_ + begin * layout_.columns[0].stride,
           (points - 1) * layout_.columns[0].stride + (last_ - first_), held);
    }
    const std::array<double*, 3> positions{block.x.data(), block.y.data(), block.z.data()};
    const std::array<float*, 3> normals{block.nx.data(), block.ny.data(), block.nz.data()};
    for (std::size_t i = 0; i < columns(); ++i) {
      const RecordColumn& column = layout_.columns[i];
      if (!together_) {
        load(column.offset + begin * column.stride, (points - 1) * column.stride + bytes_of(column.type),
             held);
      }
      const unsigned char* bytes = held.data() + (together_ ? column.offset - first_ : 0);
      if (i < 3) {
        decode(bytes, column, points, positions[i]);
      } else {
        decode(bytes, column, points, normals[i - 3]);
      }
    }
  }

 private:
  std::size_t columns() const { return layout_.normals ? 6 : 3; }
  void load(std::uint64_t offset, std::uint64_t size, std::vector<unsigned char>& held) const {
    held.resize(static_cast<std::size_t>(size));
    held.resize(bytes_->read(offset, held.data(), held.size()));
    held.resize(static_cast<std::size_t>(size));  // a file that became shorter has thrown
  }
  template <class Out>
  void decode(const unsigned char* bytes, const RecordColumn& column, std::size_t points, Out* out) const {
    with_loader(column.type, layout_.swap, [&](auto load) {
      for (std::size_t i = 0; i < points; ++i) {
        out[i] = static_cast<Out>(load(bytes + i * column.stride));
      }
    });
  }

  std::shared_ptr<const ScanBytes> bytes_;
  RecordLayout layout_;
  std::vector<Vec3> stations_;
  std::uint64_t first_ = 0;  ///< the bytes of the first point that are used: [first_, last_)
  std::uint64_t last_ = 0;
  bool together_ = true;  ///< the columns stand in one record
};

}  // namespace

std::unique_ptr<ScanReader> record_reader(const std::shared_ptr<const ScanBytes>& bytes,
                                          const RecordLayout& layout, const std::vector<Vec3>& stations) {
  return std::make_unique<RecordReader>(bytes, layout, stations);
}

double spacing_of(ScalarType type, double magnitude) {
  if (type != ScalarType::kFloat32) {
    return 0;
  }
  const auto value = static_cast<float>(std::abs(magnitude));
  return std::nextafter(value, std::numeric_limits<float>::infinity()) - value;
}

}  // namespace roomcut::ingest
