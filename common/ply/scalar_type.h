// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace roomcut {

/// The numbers that binary files of points and meshes hold.
enum class ScalarType : std::uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

constexpr std::size_t bytes_of(ScalarType type) {
  constexpr std::array<std::size_t, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
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
auto with_loader(ScalarType type, bool swap, F&& f) {
  const auto pick = [&]<class T>(T /*type tag*/) {
    return swap ? f([](const unsigned char* p) { return load_scalar<T, true>(p); })
                : f([](const unsigned char* p) { return load_scalar<T, false>(p); });
  };
  switch (type) {
    case ScalarType::kInt8:
      return pick(std::int8_t{});
    case ScalarType::kUint8:
      return pick(std::uint8_t{});
    case ScalarType::kInt16:
      return pick(std::int16_t{});
    case ScalarType::kUint16:
      return pick(std::uint16_t{});
    case ScalarType::kInt32:
      return pick(std::int32_t{});
    case ScalarType::kUint32:
      return pick(std::uint32_t{});
    case ScalarType::kFloat32:
      return pick(float{});
    default:
      return pick(double{});
  }
}

}  // namespace roomcut
