// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/ply/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>
#include <sstream>
#include <utility>

namespace roomcut {

namespace {

struct TypeName {
  std::string_view name;
  ScalarType type;
};

constexpr std::array<TypeName, 16> kTypes{{{"char", ScalarType::kInt8},
                                           {"int8", ScalarType::kInt8},
                                           {"uchar", ScalarType::kUint8},
                                           {"uint8", ScalarType::kUint8},
                                           {"short", ScalarType::kInt16},
                                           {"int16", ScalarType::kInt16},
                                           {"ushort", ScalarType::kUint16},
                                           {"uint16", ScalarType::kUint16},
                                           {"int", ScalarType::kInt32},
                                           {"int32", ScalarType::kInt32},
                                           {"uint", ScalarType::kUint32},
                                           {"uint32", ScalarType::kUint32},
                                           {"float", ScalarType::kFloat32},
                                           {"float32", ScalarType::kFloat32},
                                           {"double", ScalarType::kFloat64},
                                           {"float64", ScalarType::kFloat64}}};

/// Takes the header apart line by line; every error names the line.
class HeaderParser {
 public:
  /// Returns true at end_header.
  bool take(const std::string& text) {
    ++header_.lines;
    std::istringstream words(text);
    std::string keyword;
    words >> keyword;
    if (keyword == "format") {
      take_format(words);
    } else if (keyword == "comment") {
      header_.comments.push_back(text.substr(std::min(text.size(), text.find("comment") + 8)));
    } else if (keyword == "element") {
      take_element(words);
    } else if (keyword == "property") {
      take_property(words);
    } else if (keyword == "end_header") {
      return true;
    } else if (!keyword.empty() && keyword != "ply" && keyword != "obj_info") {
      wrong("unknown keyword '" + keyword + "'");
    }
    return false;
  }

  PlyHeader finish() {
    if (!has_format_) {
      wrong("there is no format line");
    }
    const auto vertex = std::find_if(header_.elements.begin(), header_.elements.end(),
                                     [](const PlyElement& element) { return element.name == "vertex"; });
    if (vertex == header_.elements.end()) {
      wrong("there is no element 'vertex'");
    }
    header_.vertex = static_cast<std::size_t>(vertex - header_.elements.begin());
    return std::move(header_);
  }

 private:
  [[noreturn]] void wrong(const std::string& what) const { throw PlyHeaderError(header_.lines, what); }

  ScalarType type_of(const std::string& name) const {
    const auto* const found =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const TypeName& type) { return type.name == name; });
    if (found == kTypes.end()) {
      wrong("unknown type '" + name + "'");
    }
    return found->type;
  }

  void take_format(std::istringstream& words) {
    std::string name;
    words >> name;
    if (name == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (name == "binary_little_endian") {
      header_.format = PlyFormat::kLittleEndian;
    } else if (name == "binary_big_endian") {
      header_.format = PlyFormat::kBigEndian;
    } else {
      wrong("unknown format '" + name + "'");
    }
    has_format_ = true;
  }

  void take_element(std::istringstream& words) {
    PlyElement element;
    std::string count;
    words >> element.name >> count;
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (count.empty() || error != std::errc() || end != count.data() + count.size()) {
      wrong("'" + count + "' is no count of elements");
    }
    header_.elements.push_back(element);
  }

  void take_property(std::istringstream& words) {
    if (header_.elements.empty()) {
      wrong("a property before the first element");
    }
    PlyProperty property;
    std::string type;
    words >> type;
    if (type == "list") {
      property.is_list = true;
      std::string count_type;
      words >> count_type >> type;
      property.count_type = type_of(count_type);
      if (property.count_type == ScalarType::kFloat32 || property.count_type == ScalarType::kFloat64) {
        wrong("the length of a list must be an integer");
      }
    }
    property.type = type_of(type);
    if (!(words >> property.name)) {
      wrong("a property without a name");
    }
    header_.elements.back().properties.push_back(property);
  }

  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

bool PlyElement::has_list() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.is_list; });
}

std::uint64_t PlyElement::smallest_record() const {
  return std::accumulate(properties.begin(), properties.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const PlyProperty& property) {
                           return sum + bytes_of(property.is_list ? property.count_type : property.type);
                         });
}

std::optional<PlyHeader> parse_ply_header(std::string_view text) {
  HeaderParser parser;
  const bool pairs = text.find('\n') == text.find('\r') + 1;  // else a '\n' behind a '\r' may be a value's
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    if (end == text.size() && text.substr(begin) != "end_header") {
      break;  // a line cut in its middle says nothing
    }
    const bool windows = pairs && text.substr(end, 2) == "\r\n";
    const bool done = parser.take(std::string(text.substr(begin, end - begin)));
    begin = std::min(text.size(), end + (windows ? 2 : 1));
    if (done) {
      PlyHeader header = parser.finish();
      header.data_offset = begin;
      return header;
    }
  }
  return std::nullopt;
}

}  // namespace roomcut
