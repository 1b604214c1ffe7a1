// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/byte_range.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace roomcut::view {

namespace {

/// The number that `text` consists of, the largest one when it is too large; nullopt when it is no number.
std::optional<std::uint64_t> number(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string_view::npos) {
    return std::nullopt;
  }
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() ? value : std::numeric_limits<std::uint64_t>::max();
}

}  // namespace

std::optional<ByteRange> byte_range(std::string_view header, std::uint64_t size) {
  const ByteRange everything{0, size, true};
  constexpr std::string_view kUnit = "bytes=";
  const std::size_t dash = header.find('-');
  if (!header.starts_with(kUnit) || dash == std::string_view::npos) {
    return everything;
  }
  const std::string_view from = header.substr(kUnit.size(), dash - kUnit.size());
  const std::string_view to = header.substr(dash + 1);
  const auto first = number(from);
  const auto last = number(to);
  if (from.empty() && last) {  // the last bytes
    const std::uint64_t length = std::min(*last, size);
    return length == 0 ? std::nullopt : std::optional(ByteRange{size - length, length, false});
  }
  if (!first || (!last && !to.empty()) || (last && *last < *first)) {
    return everything;
  }
  if (*first >= size) {
    return std::nullopt;
  }
  const std::uint64_t end = last && *last < size ? *last + 1 : size;
  return ByteRange{*first, end - *first, false};
}

}  // namespace roomcut::view
