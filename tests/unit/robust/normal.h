// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "common/random/counter_random.h"

namespace roomcut::testing {

/// Normal random numbers, the same on every machine.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : seed_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * random_unit(seed_, 1, count_++); }
  double operator()(double sigma) {
    const double u = random_unit(seed_, 2, count_++);
    const double v = random_unit(seed_, 3, count_++);
    return sigma * std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * std::numbers::pi * v);
  }

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

}  // namespace roomcut::testing
