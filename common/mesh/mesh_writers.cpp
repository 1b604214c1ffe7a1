// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <charconv>
#include <cstring>

#include "common/mesh/mesh_io.h"

namespace roomcut {

namespace {

static_assert(std::endian::native == std::endian::little,
              "PLY files are written in this machine's byte order");

template <class T>
void put(std::string& out, T value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  out.append(bytes.data(), sizeof(T));
}

void put_number(std::string& out, double value) {
  std::array<char, 40> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value == 0 ? 0.0 : value);  // no "-0"
  out.append(text.data(), end.ptr);
}

void put_number(std::string& out, std::int64_t value) {
  out += std::to_string(value);
}

void put_point(std::string& out, const Vec3& p) {
  put_number(out, p.x());
  out += ' ';
  put_number(out, p.y());
  out += ' ';
  put_number(out, p.z());
  out += '\n';
}

std::string ply_header(const TriangleMesh& mesh, const std::vector<std::string>& comments,
                       const VertexExtras& extras) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : comments) {
    text += "comment " + comment + "\n";
  }
  text += "element vertex " + std::to_string(mesh.vertices.size()) + "\n";
  text += "property double x\nproperty double y\nproperty double z\n";
  if (!extras.colour.empty()) {
    text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  }
  if (!extras.distance_m.empty()) {
    text += "property float distance\n";
  }
  text +=
      "element face " + std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\n";
  if (!mesh.kind.empty()) text += "property uchar kind\n";
  if (!mesh.storey.empty()) text += "property short storey\n";
  if (!mesh.region.empty()) text += "property int region\n";
  return text + "end_header\n";
}

}  // namespace

std::string ply_bytes(const TriangleMesh& mesh, const Vec3& origin, const std::vector<std::string>& comments,
                      const VertexExtras& extras) {
  std::string out = ply_header(mesh, comments, extras);
  out.reserve(out.size() + 31 * mesh.vertices.size() + 20 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 p = mesh.vertices[i] + origin;
    put(out, p.x());
    put(out, p.y());
    put(out, p.z());
    if (!extras.colour.empty()) {
      for (const std::uint8_t channel : extras.colour[i]) {
        put(out, channel);
      }
    }
    if (!extras.distance_m.empty()) put(out, extras.distance_m[i]);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    put(out, std::uint8_t{3});
    for (const std::int32_t v : mesh.triangles[t]) {
      put(out, v);
    }
    if (!mesh.kind.empty()) put(out, mesh.kind[t]);
    if (!mesh.storey.empty()) put(out, mesh.storey[t]);
    if (!mesh.region.empty()) put(out, mesh.region[t]);
  }
  return out;
}

std::string off_text(const TriangleMesh& mesh, const Vec3& origin) {
  std::string out =
      "OFF\n" + std::to_string(mesh.vertices.size()) + " " + std::to_string(mesh.triangles.size()) + " 0\n";
  for (const Vec3& p : mesh.vertices) {
    put_point(out, p + origin);
  }
  for (const Triangle& t : mesh.triangles) {
    out += '3';
    for (const std::int32_t v : t) {
      out += ' ';
      put_number(out, std::int64_t{v});
    }
    out += '\n';
  }
  return out;
}

std::string obj_text(const std::vector<Vec3>& vertices, const std::vector<ObjGroup>& groups,
                     const Vec3& origin, const std::vector<std::string>& comments) {
  std::string out;
  for (const std::string& comment : comments) {
    out += "# " + comment + "\n";
  }
  for (const Vec3& p : vertices) {
    out += "v ";
    put_point(out, p + origin);
  }
  for (const ObjGroup& group : groups) {
    out += "g " + group.name + "\n";
    for (const auto& polygon : group.polygons) {
      out += 'f';
      for (const std::int32_t v : polygon) {
        out += ' ';
        put_number(out, std::int64_t{v} + 1);
      }
      out += '\n';
    }
  }
  return out;
}

}  // namespace roomcut
