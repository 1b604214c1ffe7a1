// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstring>

#include "stages/ingest/ply_header.h"
#include "stages/ingest/scan_reader.h"

namespace roomcut {

/// Where x, y, z, nx, ny, nz stand among the properties of an element.
struct PlyColumns {
  std::array<std::size_t, 6> property{};
  bool normals = false;
  int count() const { return normals ? 6 : 3; }
};

/// Errors: kScanFormat when x, y or z is missing, a list, or stands twice.
PlyColumns find_columns(const PlyElement& vertex, const ScanBytes& file);

/// The i-th of x, y, z, nx, ny, nz of point `point`.
inline void store_column(ScanBlock& block, int column, std::size_t point, double value) {
  switch (column) {
    case 0:
      block.x[point] = value;
      break;
    case 1:
      block.y[point] = value;
      break;
    case 2:
      block.z[point] = value;
      break;
    case 3:
      block.nx[point] = static_cast<float>(value);
      break;
    case 4:
      block.ny[point] = static_cast<float>(value);
      break;
    default:
      block.nz[point] = static_cast<float>(value);
      break;
  }
}

/// Reads a T that may stand unaligned and in the other byte order.
template <class T, bool kSwap>
T load_scalar(const unsigned char* bytes) {
  T value;
  if constexpr (kSwap) {
    std::array<unsigned char, sizeof(T)> turned;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      turned[i] = bytes[sizeof(T) - 1 - i];
    }
    std::memcpy(&value, turned.data(), sizeof(T));
  } else {
    std::memcpy(&value, bytes, sizeof(T));
  }
  return value;
}

/// Calls f(load) with the function that reads a scalar of this type and byte order as a T.
template <class F>
auto with_loader(PlyType type, bool swap, F&& f) {
  const auto pick = [&]<class T>(T /*type tag*/) {
    return swap ? f([](const unsigned char* p) { return load_scalar<T, true>(p); })
                : f([](const unsigned char* p) { return load_scalar<T, false>(p); });
  };
  switch (type) {
    case PlyType::kInt8:
      return pick(std::int8_t{});
    case PlyType::kUint8:
      return pick(std::uint8_t{});
    case PlyType::kInt16:
      return pick(std::int16_t{});
    case PlyType::kUint16:
      return pick(std::uint16_t{});
    case PlyType::kInt32:
      return pick(std::int32_t{});
    case PlyType::kUint32:
      return pick(std::uint32_t{});
    case PlyType::kFloat32:
      return pick(float{});
    default:
      return pick(double{});
  }
}

}  // namespace roomcut
