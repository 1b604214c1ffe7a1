// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "common/mesh/mesh_readers.h"

namespace roomcut::mesh_readers {

namespace {

enum class Encoding { kAscii, kLittle, kBig };

struct Scalar {
  std::size_t bytes = 0;
  enum class Kind { kSigned, kUnsigned, kFloating } kind = Kind::kSigned;
};

struct Property {
  std::string name;
  Scalar type;
  std::optional<Scalar> count_type;  // set for lists
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

std::optional<Scalar> scalar_named(std::string_view word) {
  using Kind = Scalar::Kind;
  if (word == "char" || word == "int8") return Scalar{1, Kind::kSigned};
  if (word == "uchar" || word == "uint8") return Scalar{1, Kind::kUnsigned};
  if (word == "short" || word == "int16") return Scalar{2, Kind::kSigned};
  if (word == "ushort" || word == "uint16") return Scalar{2, Kind::kUnsigned};
  if (word == "int" || word == "int32") return Scalar{4, Kind::kSigned};
  if (word == "uint" || word == "uint32") return Scalar{4, Kind::kUnsigned};
  if (word == "float" || word == "float32") return Scalar{4, Kind::kFloating};
  if (word == "double" || word == "float64") return Scalar{8, Kind::kFloating};
  return std::nullopt;
}

class PlyReader {
 public:
  PlyReader(std::string_view content, const std::string& name) : content_(content), name_(name) {}

  TriangleMesh read() {
    read_header();
    for (const Element& element : elements_) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        for (std::int64_t i = 0; i < element.count; ++i) {
          skip_row(element);
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  std::string_view header_line() {
    const std::size_t end = content_.find('\n', at_);
    if (end == std::string_view::npos) bad_mesh(name_, "the header has no end");
    std::string_view line = content_.substr(at_, end - at_);
    at_ = end + 1;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  void read_header() {
    header_line();
    for (std::string_view line = header_line(); line != "end_header"; line = header_line()) {
      TextCursor cursor(line);
      if (!cursor.next_line()) continue;
      const std::string_view keyword = cursor.word();
      if (keyword == "format") {
        const std::string_view word = cursor.word();
        encoding_ = word == "ascii"               ? Encoding::kAscii
                    : word == "binary_big_endian" ? Encoding::kBig
                                                  : Encoding::kLittle;
      } else if (keyword == "element") {
        Element element{std::string(cursor.word()), 0, {}};
        if (!cursor.number(element.count) || element.count < 0)
          bad_mesh(name_, "a bad element in the header");
        elements_.push_back(std::move(element));
      } else if (keyword == "property") {
        add_property(cursor);
      }
    }
    for (const Element& element : elements_) {
      // Every row takes at least two bytes per property in any encoding but uchar's.
      const auto left = static_cast<std::int64_t>(content_.size() - at_);
      if (element.count > left) bad_mesh(name_, "the header promises more than the file holds");
    }
  }

  void add_property(TextCursor& cursor) {
    if (elements_.empty()) bad_mesh(name_, "a property before the first element");
    Property property;
    std::string_view type = cursor.word();
    if (type == "list") {
      property.count_type = scalar_named(cursor.word());
      if (!property.count_type) bad_mesh(name_, "a list with an unknown type of count");
      type = cursor.word();
    }
    const auto scalar = scalar_named(type);
    if (!scalar) bad_mesh(name_, "unknown property type '" + std::string(type) + "'");
    property.type = *scalar;
    property.name = cursor.word();
    elements_.back().properties.push_back(std::move(property));
  }

  double value(const Scalar& type) {
    if (encoding_ == Encoding::kAscii) {
      const std::size_t first = std::min(content_.find_first_not_of(" \t\r\n", at_), content_.size());
      const std::size_t last = std::min(content_.find_first_of(" \t\r\n", first), content_.size());
      at_ = last;
      double out = 0;
      TextCursor cursor(content_.substr(first, last - first));
      if (!cursor.next_line() || !cursor.number(out)) truncated();
      return out;
    }
    if (content_.size() - at_ < type.bytes) truncated();
    std::array<char, 8> bytes{};
    std::copy_n(content_.data() + at_, type.bytes, bytes.data());
    at_ += type.bytes;
    if (encoding_ == Encoding::kBig)
      std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(type.bytes));
    return decode(bytes, type);
  }

  static double decode(const std::array<char, 8>& bytes, const Scalar& type) {
    static_assert(std::endian::native == std::endian::little);
    if (type.kind == Scalar::Kind::kFloating) {
      if (type.bytes == 8) return std::bit_cast<double>(bytes);
      float f = 0;
      std::memcpy(&f, bytes.data(), sizeof f);
      return static_cast<double>(f);
    }
    std::uint32_t u = 0;
    std::memcpy(&u, bytes.data(), type.bytes);
    if (type.kind == Scalar::Kind::kUnsigned) return static_cast<double>(u);
    if (type.bytes == 1) return static_cast<double>(static_cast<std::int8_t>(u));
    if (type.bytes == 2) return static_cast<double>(static_cast<std::int16_t>(u));
    return static_cast<double>(static_cast<std::int32_t>(u));
  }

  [[noreturn]] void truncated() {
    bad_mesh(name_, "the file ends early, or byte " + std::to_string(at_) + " is no number");
  }

  /// `v`, which must be a whole number in the range: a file may hold NaN where it says that an index stands.
  std::int64_t whole(double v, double least, double most, const char* what) {
    if (!(v >= least && v <= most) || v != std::floor(v)) {
      bad_mesh(name_, std::string(what) + " before byte " + std::to_string(at_) + " is " + std::to_string(v));
    }
    return static_cast<std::int64_t>(v);
  }

  std::int64_t list_length(const Property& property) {
    return whole(value(*property.count_type), 0, static_cast<double>(content_.size() - at_) + 1,
                 "a list's length");
  }

  void skip_row(const Element& element) {
    for (const Property& property : element.properties) {
      std::int64_t values = property.count_type ? list_length(property) : 1;
      while (values-- > 0) {
        value(property.type);
      }
    }
  }

  void read_vertices(const Element& element) {
    for (std::int64_t i = 0; i < element.count; ++i) {
      Vec3 p{NAN, NAN, NAN};
      for (const Property& property : element.properties) {
        if (property.count_type) {
          for (std::int64_t n = list_length(property); n > 0; --n) value(property.type);
          continue;
        }
        const double v = value(property.type);
        if (property.name == "x") p.x() = v;
        if (property.name == "y") p.y() = v;
        if (property.name == "z") p.z() = v;
      }
      if (!p.allFinite()) bad_mesh(name_, "vertex " + std::to_string(i) + " has no finite x, y, z");
      append_vertex(mesh_, p, name_);
    }
  }

  void read_faces(const Element& element) {
    std::vector<std::int64_t> corners;
    for (std::int64_t i = 0; i < element.count; ++i) {
      corners.clear();
      std::array<std::optional<double>, 3> extras;  // kind, storey, region
      for (const Property& property : element.properties) {
        if (property.count_type) {
          const bool wanted = property.name == "vertex_indices" || property.name == "vertex_index";
          for (std::int64_t n = list_length(property); n > 0; --n) {
            const double v = value(property.type);
            if (wanted) {
              corners.push_back(
                  whole(v, 0, static_cast<double>(mesh_.vertices.size()) - 1, "a vertex number"));
            }
          }
          continue;
        }
        const double v = value(property.type);
        if (property.name == "kind") extras[0] = static_cast<double>(whole(v, 0, 3, "a face's kind"));
        if (property.name == "storey") {
          extras[1] = static_cast<double>(whole(v, INT16_MIN, INT16_MAX, "a face's storey"));
        }
        if (property.name == "region") {
          extras[2] = static_cast<double>(whole(v, INT32_MIN, INT32_MAX, "a face's region"));
        }
      }
      const std::size_t triangles = append_face(mesh_, corners, name_);
      if (extras[0] && extras[1] && extras[2]) {
        mesh_.kind.insert(mesh_.kind.end(), triangles, static_cast<std::uint8_t>(*extras[0]));
        mesh_.storey.insert(mesh_.storey.end(), triangles, static_cast<std::int16_t>(*extras[1]));
        mesh_.region.insert(mesh_.region.end(), triangles, static_cast<std::int32_t>(*extras[2]));
      }
    }
  }

  std::string_view content_;
  const std::string& name_;
  std::size_t at_ = 0;
  Encoding encoding_ = Encoding::kLittle;
  std::vector<Element> elements_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh parse_ply(std::string_view content, const std::string& name) {
  return PlyReader(content, name).read();
}

}  // namespace roomcut::mesh_readers
