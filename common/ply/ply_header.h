// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/ply/scalar_type.h"

namespace roomcut {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::kFloat32;
  bool is_list = false;
  ScalarType count_type = ScalarType::kUint8;  ///< lists only
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as promised
  std::vector<PlyProperty> properties;
  bool has_list() const;
  /// Bytes of one binary record with every list empty: exact without lists, a lower bound with them.
  std::uint64_t smallest_record() const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;
  std::uint64_t data_offset = 0;  ///< first byte after the header
  std::size_t lines = 0;          ///< header lines, for line numbers of an ascii body
  std::size_t vertex = 0;         ///< index of the vertex element
};

/// Readers look no further for the end of a header [bytes].
inline constexpr std::size_t kLargestPlyHeader = 1 << 20;

/// What is wrong in a header; readers add the name of the file and the code of their errors.
struct PlyHeaderError : std::runtime_error {
  PlyHeaderError(std::size_t at, const std::string& what) : std::runtime_error(what), line(at), cause(what) {}
  std::size_t line;   ///< of the header, from 1
  std::string cause;  ///< for people; may hold any bytes of the file, NUL too, at which what() ends
};

/// The header at the beginning of `text`; none when it does not end in there. Lines may end in CR, LF or
/// both. Throws PlyHeaderError: unknown words, types or formats; no format; no vertices; a count that is
/// none.
std::optional<PlyHeader> parse_ply_header(std::string_view text);

}  // namespace roomcut
