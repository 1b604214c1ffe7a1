// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

namespace roomcut::ingest {

/// Sums over points of their integer coordinates (units of fixed_grid.h, from one corner per tile) and of the
/// products, and their number: one cache line. All arithmetic is modulo 2^32 or 2^64: the sums may wrap, but
/// a difference that is small in truth, as a centred moment is, comes out exactly. So the result does not
/// depend on order, tile or thread.
struct alignas(64) Moments {
  std::array<std::uint32_t, 4> sum{};      ///< x, y, z, number of points
  std::array<std::uint64_t, 6> product{};  ///< xx, xy, xz, yy, yz, zz

  std::uint32_t points() const { return sum[3]; }
  void add_point(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const std::uint64_t a = x;
    const std::uint64_t b = y;
    const std::uint64_t c = z;
    sum[0] += x;
    sum[1] += y;
    sum[2] += z;
    ++sum[3];
    product[0] += a * a;
    product[1] += a * b;
    product[2] += a * c;
    product[3] += b * b;
    product[4] += b * c;
    product[5] += c * c;
  }
};

/// Adds moments up, two or four numbers at a time: vector types of GCC and Clang, which any processor can do.
class MomentSum {
 public:
  void add(const Moments& other) {
    sum_ += load<Four>(other.sum.data());
    for (std::size_t i = 0; i < product_.size(); ++i) {
      product_[i] += load<Two>(other.product.data() + 2 * i);
    }
  }
  Moments total() const {
    Moments moments;
    std::memcpy(moments.sum.data(), &sum_, sizeof(Four));
    std::memcpy(moments.product.data(), product_.data(), sizeof(product_));
    return moments;
  }

 private:
  using Four = std::uint32_t __attribute__((vector_size(16)));
  using Two = std::uint64_t __attribute__((vector_size(16)));
  template <class Vector>
  static Vector load(const void* from) {
    Vector vector;
    std::memcpy(&vector, from, sizeof(Vector));
    return vector;
  }
  Four sum_{};
  std::array<Two, 3> product_{};
};

/// Mean and covariance of n points about a centre, in units.
struct Spread {
  std::array<double, 3> mean{};        ///< from the centre
  std::array<double, 6> covariance{};  ///< xx, xy, xz, yy, yz, zz
};

/// `centre` in the units and from the corner of the moments. Exact while the centred sums fit: as long as the
/// largest distance from the centre, in units, times the number of points is below 2^31.
inline Spread spread_of(const Moments& m, const std::array<std::uint32_t, 3>& centre) {
  Spread spread;
  const std::uint64_t n = m.points();
  const double inverse = 1.0 / static_cast<double>(n);
  std::array<std::int64_t, 3>
      centred{};  // sums from the centre; the low 32 bits are exact, the sign restores the rest
  for (std::size_t i = 0; i < 3; ++i) {
    centred[i] = static_cast<std::int32_t>(m.sum[i] - m.points() * centre[i]);
    spread.mean[i] = static_cast<double>(centred[i]) * inverse;
  }
  std::size_t k = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j, ++k) {
      // sum of (a - c)(b - d) = sum ab - c sum (b - d) - d sum (a - c) - n c d
      const std::uint64_t c = centre[i];
      const std::uint64_t d = centre[j];
      const std::uint64_t product = m.product[k] - c * static_cast<std::uint64_t>(centred[j]) -
                                    d * static_cast<std::uint64_t>(centred[i]) - n * c * d;
      spread.covariance[k] =
          static_cast<double>(static_cast<std::int64_t>(product)) * inverse - spread.mean[i] * spread.mean[j];
    }
  }
  return spread;
}

}  // namespace roomcut::ingest
