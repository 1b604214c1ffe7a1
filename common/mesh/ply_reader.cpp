// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "common/mesh/mesh_readers.h"
#include "common/ply/ply_header.h"

namespace roomcut::mesh_readers {

namespace {

class PlyReader {
 public:
  PlyReader(std::string_view content, const std::string& name) : content_(content), name_(name) {}

  TriangleMesh read() {
    read_header();
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        for (std::uint64_t i = 0; i < element.count; ++i) {
          skip_row(element);
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  void read_header() {
    try {
      std::optional<PlyHeader> header = parse_ply_header(content_.substr(0, kLargestPlyHeader));
      if (!header) bad_mesh(name_, "the header has no end");
      header_ = std::move(*header);
    } catch (const PlyHeaderError& wrong) {
      bad_mesh(name_, "header line " + std::to_string(wrong.line) + ": " + wrong.cause);
    }
    at_ = header_.data_offset;
    for (const PlyElement& element : header_.elements) {
      // Every row takes a byte at least.
      if (element.count > content_.size() - at_) {
        bad_mesh(name_, "the header promises more than the file holds");
      }
    }
  }

  double value(ScalarType type) {
    if (header_.format == PlyFormat::kAscii) {
      const std::size_t first = std::min(content_.find_first_not_of(" \t\r\n", at_), content_.size());
      const std::size_t last = std::min(content_.find_first_of(" \t\r\n", first), content_.size());
      at_ = last;
      double out = 0;
      TextCursor cursor(content_.substr(first, last - first));
      if (!cursor.next_line() || !cursor.number(out)) truncated();
      return out;
    }
    const std::size_t bytes = bytes_of(type);
    if (content_.size() - at_ < bytes) truncated();
    static_assert(std::endian::native == std::endian::little);
    const auto* from = reinterpret_cast<const unsigned char*>(content_.data() + at_);
    at_ += bytes;
    return with_loader(type, header_.format == PlyFormat::kBigEndian,
                       [&](auto load) { return static_cast<double>(load(from)); });
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

  std::int64_t list_length(const PlyProperty& property) {
    return whole(value(property.count_type), 0, static_cast<double>(content_.size() - at_) + 1,
                 "a list's length");
  }

  void skip_row(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      std::int64_t values = property.is_list ? list_length(property) : 1;
      while (values-- > 0) {
        value(property.type);
      }
    }
  }

  void read_vertices(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      Vec3 p{NAN, NAN, NAN};
      for (const PlyProperty& property : element.properties) {
        if (property.is_list) {
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

  void read_faces(const PlyElement& element) {
    std::vector<std::int64_t> corners;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      corners.clear();
      std::array<std::optional<double>, 3> extras;  // kind, storey, region
      for (const PlyProperty& property : element.properties) {
        if (property.is_list) {
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
  PlyHeader header_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh parse_ply(std::string_view content, const std::string& name) {
  return PlyReader(content, name).read();
}

}  // namespace roomcut::mesh_readers
