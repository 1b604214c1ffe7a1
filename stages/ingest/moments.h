// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace roomcut {

/// Sums over points of their integer coordinates (units of fixed_grid.h, from one corner per tile) and of the
/// products: x, y, z, xx, xy, xz, yy, yz, zz. All arithmetic is modulo 2^64: the sums may wrap, but a
/// difference that is small in truth, as a centred moment is, comes out exactly. So the result does not
/// depend on order, tile or thread.
struct Moments {
  std::array<std::uint64_t, 9> s{};

  void add_point(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const std::uint64_t a = x;
    const std::uint64_t b = y;
    const std::uint64_t c = z;
    s[0] += a;
    s[1] += b;
    s[2] += c;
    s[3] += a * a;
    s[4] += a * b;
    s[5] += a * c;
    s[6] += b * b;
    s[7] += b * c;
    s[8] += c * c;
  }
  void add(const Moments& other) {
    for (std::size_t i = 0; i < s.size(); ++i) {
      s[i] += other.s[i];
    }
  }
};

/// Mean and covariance of n points about a centre, in units.
struct Spread {
  std::array<double, 3> mean{};        ///< from the centre
  std::array<double, 6> covariance{};  ///< xx, xy, xz, yy, yz, zz
};

/// `centre` in the units and from the corner of the moments; it must lie within 2^20 units of the points.
inline Spread spread_of(const Moments& m, std::uint64_t n, const std::array<std::uint64_t, 3>& centre) {
  const auto signed_value = [](std::uint64_t wrapped) {
    return static_cast<double>(static_cast<std::int64_t>(wrapped));
  };
  Spread spread;
  const double inverse = 1.0 / static_cast<double>(n);
  for (std::size_t i = 0; i < 3; ++i) {
    spread.mean[i] = signed_value(m.s[i] - n * centre[i]) * inverse;
  }
  std::size_t k = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j, ++k) {
      const std::uint64_t product =
          m.s[3 + k] - centre[i] * m.s[j] - centre[j] * m.s[i] + n * centre[i] * centre[j];
      spread.covariance[k] = signed_value(product) * inverse - spread.mean[i] * spread.mean[j];
    }
  }
  return spread;
}

}  // namespace roomcut
