// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "common/artefact/h5_parser.h"

/// The messages of an object header: what it says of a dataset's type, shape and place, and its attributes.
namespace roomcut::h5 {

/// Reads little-endian numbers one after the other; throws Malformed at the end of the bytes.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  template <class T>
  T number() {
    T value{};
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::span<const std::uint8_t> take(std::size_t count) {
    if (count > bytes_.size()) {
      throw Malformed{"", "a structure of the file ends too early"};
    }
    const auto taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }
  std::size_t left() const { return bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
};

enum class MessageType : std::uint16_t {
  kDataspace = 0x01,
  kLinkInfo = 0x02,
  kDatatype = 0x03,
  kLink = 0x06,
  kExternalFiles = 0x07,
  kLayout = 0x08,
  kFilters = 0x0b,
  kAttribute = 0x0c,
  kContinuation = 0x10,
  kSymbolTable = 0x11,
  kAttributeInfo = 0x15,
};

struct Message {
  MessageType type;
  std::uint8_t flags;
  std::vector<std::uint8_t> data;
};

/// "f32", "i64", "u8" …; empty for a type of number that artefacts do not have, and for all else.
std::string number_type(std::span<const std::uint8_t> datatype);

/// Sizes of the dimensions; none for a single value.
std::vector<std::uint64_t> sizes_of(std::span<const std::uint8_t> dataspace);

/// Name and value. Malformed when it is of no type that artefacts have, not finite, or no UTF-8.
std::pair<std::string, AttributeValue> parse_attribute(std::span<const std::uint8_t> message);

/// Malformed unless the data are contiguous, in this file, and end before it does.
StoredDataset parse_dataset(const std::vector<Message>& messages, std::uint64_t file_bytes);

}  // namespace roomcut::h5
