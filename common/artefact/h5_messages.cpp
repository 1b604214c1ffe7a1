// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/h5_messages.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/artefact/json.h"

namespace roomcut::h5 {

namespace {

constexpr std::size_t kAlign = 8;

std::size_t padded(std::size_t size) {
  return (size + kAlign - 1) / kAlign * kAlign;
}

/// The head of every datatype message.
struct Datatype {
  int type_class = 0;
  std::uint32_t bits = 0;
  std::uint32_t size = 0;
  std::span<const std::uint8_t> properties;

  explicit Datatype(std::span<const std::uint8_t> message) {
    ByteReader reader(message);
    const auto first = reader.number<std::uint32_t>();
    type_class = static_cast<int>(first & 15U);
    bits = first >> 8;
    size = reader.number<std::uint32_t>();
    properties = reader.take(reader.left());
  }
  bool has(std::initializer_list<std::uint8_t> wanted) const {
    return properties.size() >= wanted.size() && std::equal(wanted.begin(), wanted.end(), properties.begin());
  }
};

constexpr int kInteger = 0;
constexpr int kFloat = 1;
constexpr int kText = 3;

std::string integer_type(const Datatype& type) {
  constexpr std::uint32_t kSigned = 8;  // all other bits: big-endian, padding
  const bool whole = type.has({0, 0, static_cast<std::uint8_t>(8 * type.size), 0});
  const bool known = std::has_single_bit(type.size) && type.size <= 8;
  if (!known || !whole || (type.bits | kSigned) != kSigned) {
    return "";
  }
  return (type.bits == kSigned ? "i" : "u") + std::to_string(8 * type.size);
}

std::string float_type(const Datatype& type) {
  // IEEE 754, little-endian: implied leading bit; sign, exponent and mantissa where they belong.
  if (type.size == 4 && type.bits == 0x1f20 && type.has({0, 0, 32, 0, 23, 8, 0, 23, 127, 0, 0, 0})) {
    return "f32";
  }
  const bool wide =
      type.size == 8 && type.bits == 0x3f20 && type.has({0, 0, 64, 0, 52, 11, 0, 52, 0xff, 3, 0, 0});
  return wide ? "f64" : "";
}

template <class T>
T number_of(std::span<const std::uint8_t> data) {
  return ByteReader(data).number<T>();
}

double finite(double value) {
  if (!std::isfinite(value)) {
    throw Malformed{"", "is not finite"};
  }
  return value;
}

AttributeValue value_of(std::span<const std::uint8_t> datatype, std::uint64_t count,
                        std::span<const std::uint8_t> data) {
  const Datatype type(datatype);
  const std::string number = number_type(datatype);
  if (type.type_class == kText && count == 1 && type.size <= data.size()) {
    std::string text(data.begin(), data.begin() + type.size);
    text.resize(text.find_last_not_of('\0') + 1);
    if (!is_utf8(text)) {
      throw Malformed{"", "is no UTF-8"};
    }
    return text;
  }
  if (number == "f64" && count == 1) {
    return finite(number_of<double>(data));
  }
  if (number == "f64" && count == 3) {
    ByteReader reader(data);
    std::array<double, 3> vector{};
    for (double& value : vector) {
      value = finite(reader.number<double>());
    }
    return vector;
  }
  if (number == "i64" && count == 1) {
    return number_of<std::int64_t>(data);
  }
  throw Malformed{"", "is of no type that artefacts have"};
}

/// The data of the one message of a type.
std::span<const std::uint8_t> the(const std::vector<Message>& messages, MessageType type) {
  const auto found =
      std::find_if(messages.begin(), messages.end(), [type](const Message& m) { return m.type == type; });
  if (found == messages.end()) {
    throw Malformed{"", "the dataset has no type, no shape or no data"};
  }
  return found->data;
}

std::uint64_t bytes_of(std::uint64_t bytes, const std::vector<std::uint64_t>& shape) {
  for (const std::uint64_t n : shape) {
    if (n != 0 && bytes > std::numeric_limits<std::uint64_t>::max() / n) {
      throw Malformed{"", "the dataset claims an impossible size"};
    }
    bytes *= n;
  }
  return bytes;
}

}  // namespace

std::string number_type(std::span<const std::uint8_t> datatype) {
  const Datatype type(datatype);
  if (type.type_class == kInteger) {
    return integer_type(type);
  }
  return type.type_class == kFloat ? float_type(type) : "";
}

std::vector<std::uint64_t> sizes_of(std::span<const std::uint8_t> dataspace) {
  ByteReader reader(dataspace);
  const auto version = reader.number<std::uint8_t>();
  const auto dimensions = reader.number<std::uint8_t>();
  reader.take(version == 1 ? 6 : 2);  // flags, kind; the largest sizes, which may follow, are not needed
  if (version != 1 && version != 2) {
    throw Malformed{"", "the shape is of a kind that artefacts do not have"};
  }
  std::vector<std::uint64_t> sizes(dimensions);
  for (std::uint64_t& size : sizes) {
    size = reader.number<std::uint64_t>();
  }
  return sizes;
}

std::pair<std::string, AttributeValue> parse_attribute(std::span<const std::uint8_t> message) {
  ByteReader reader(message);
  const auto version = reader.number<std::uint8_t>();
  const auto flags = reader.number<std::uint8_t>();
  const std::size_t name_size = reader.number<std::uint16_t>();
  const std::size_t type_size = reader.number<std::uint16_t>();
  const std::size_t space_size = reader.number<std::uint16_t>();
  if ((version != 1 && version != 3) || (version == 3 && flags != 0)) {
    throw Malformed{"", "an attribute is of a kind that artefacts do not have"};
  }
  if (version == 3) {
    reader.take(1);  // the character set of the name
  }
  const auto part = [&](std::size_t size) {
    return reader.take(version == 1 ? padded(size) : size).first(size);
  };
  const auto name_bytes = part(name_size);
  const std::string name(name_bytes.begin(), std::find(name_bytes.begin(), name_bytes.end(), 0));
  if (name.empty() || !is_utf8(name)) {
    throw Malformed{"", "an attribute has no name"};
  }
  const auto type = part(type_size);
  const std::vector<std::uint64_t> sizes = sizes_of(part(space_size));
  try {
    const std::uint64_t count = bytes_of(1, sizes);
    return {name, value_of(type, count, reader.take(reader.left()))};
  } catch (const Malformed& trouble) {
    throw Malformed{"", "attribute " + name + " " + trouble.what};
  }
}

StoredDataset parse_dataset(const std::vector<Message>& messages, std::uint64_t file_bytes) {
  constexpr std::uint8_t kLayoutVersion = 3;
  constexpr std::uint8_t kContiguous = 1;
  constexpr std::uint64_t kUndefined = ~std::uint64_t{0};
  const auto datatype = the(messages, MessageType::kDatatype);
  StoredDataset stored;
  stored.type = number_type(datatype);
  if (stored.type.empty()) {
    throw Malformed{"", "the dataset does not hold numbers of a type that artefacts have"};
  }
  stored.shape = sizes_of(the(messages, MessageType::kDataspace));
  if (stored.shape.empty()) {
    throw Malformed{"", "the dataset has no shape"};
  }
  stored.bytes = bytes_of(Datatype(datatype).size, stored.shape);
  const bool elsewhere = std::any_of(messages.begin(), messages.end(), [](const Message& message) {
    return message.type == MessageType::kExternalFiles || message.type == MessageType::kFilters;
  });
  ByteReader layout(the(messages, MessageType::kLayout));
  const auto version = layout.number<std::uint8_t>();
  const auto kind = layout.number<std::uint8_t>();
  if (elsewhere || version != kLayoutVersion || kind != kContiguous) {
    throw Malformed{"", "the dataset is chunked, compressed or in another file, which artefacts never are"};
  }
  const auto offset = layout.number<std::uint64_t>();
  if (stored.bytes == 0) {
    return stored;
  }
  if (offset == kUndefined) {
    throw Malformed{"", "the dataset has no data"};
  }
  if (offset > file_bytes || stored.bytes > file_bytes - offset) {
    throw Malformed{"", "the file ends before the dataset does"};
  }
  stored.offset = offset;
  return stored;
}

}  // namespace roomcut::h5
