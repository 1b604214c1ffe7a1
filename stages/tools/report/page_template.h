// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace roomcut::report {

/// A named piece of the page's data: bytes that the page unpacks when it needs them.
struct PageBlock {
  std::string name;  ///< letters, digits and dashes
  std::string bytes;
  bool noisy = false;  ///< made of measured numbers, in which zlib would look for repetitions in vain
};

/// Where the template takes the data.
inline constexpr std::string_view kDataMark = "<!--roomcut-data-->";

/// `bytes` in gzip form (RFC 1952), without time or name: equal bytes give equal bytes. Three times as fast
/// at hardly larger a size as zlib's own settings: `noisy` bytes are only coded by how frequent they are.
std::string gzip(std::string_view bytes, bool noisy = false);

/// The page: the template with each block in the place of kDataMark, as
/// `<script type="application/octet-stream" id="block-<name>">base64 of gzip</script>`, one a line. Throws
/// std::invalid_argument when the template has no such place.
std::string fill_template(std::string_view page_template, const std::vector<PageBlock>& blocks);

}  // namespace roomcut::report
