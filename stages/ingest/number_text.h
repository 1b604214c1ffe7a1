// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <system_error>

namespace roomcut::ingest {

namespace number_text {

inline constexpr std::array<double, 23> kPowersOfTen{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                     1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                     1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

inline bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Collects the digits at `p` into `mantissa`, as long as 15 of them fit a double exactly; returns where it
/// stopped.
inline const char* take_digits(const char* p, const char* end, std::uint64_t& mantissa, int& digits) {
  while (p < end && is_digit(*p)) {
    mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p - '0');
    ++digits;
    ++p;
    if (digits > 18) {
      break;
    }
  }
  return p;
}

}  // namespace number_text

/// Reads the number at [p, end), as std::from_chars does (and a leading +), independent of the locale and
/// correctly rounded; plain decimals of at most 15 digits take a short cut. Returns where it ends, nullptr
/// when there is none.
inline const char* parse_number(const char* p, const char* end, double& value) {
  if (p < end && *p == '+') {
    ++p;
  }
  const char* const begin = p;
  const bool negative = p < end && *p == '-';
  p += negative ? 1 : 0;
  std::uint64_t mantissa = 0;
  int digits = 0;
  p = number_text::take_digits(p, end, mantissa, digits);
  const int whole = digits;
  if (p < end && *p == '.') {
    p = number_text::take_digits(p + 1, end, mantissa, digits);
  }
  const bool plain = digits > 0 && digits <= 15 && (p == end || (*p != 'e' && *p != 'E' && *p != '.'));
  if (plain) {  // mantissa and power of ten are both exact, so their quotient is correctly rounded
    const double size =
        static_cast<double>(mantissa) / number_text::kPowersOfTen[static_cast<std::size_t>(digits - whole)];
    value = negative ? -size : size;
    return p;
  }
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range) {
    value = std::numeric_limits<double>::quiet_NaN();  // no coordinate: dropped and counted with the others
    return stop;
  }
  return error == std::errc() ? stop : nullptr;
}

}  // namespace roomcut::ingest
