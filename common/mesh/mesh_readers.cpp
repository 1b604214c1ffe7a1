// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/mesh_readers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/mesh/mesh_io.h"
#include "common/mesh/planar_triangulation.h"

namespace roomcut {

namespace mesh_readers {

void bad_mesh(const std::string& name, const std::string& what) {
  throw StageError(errors::kMeshFormat, name, what, "PLY, OFF and OBJ with triangles or polygons are read");
}

void append_vertex(TriangleMesh& mesh, const Vec3& p, const std::string& name) {
  constexpr double kLargest = 1e10;  // the Earth's size in millimetres
  if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kLargest) {
    bad_mesh(name, "vertex " + std::to_string(mesh.vertices.size()) + " has a coordinate that is no place's");
  }
  mesh.vertices.push_back(p);
}

std::size_t append_face(TriangleMesh& mesh, std::span<const std::int64_t> corners, const std::string& name) {
  if (corners.size() < 3) {
    bad_mesh(name, "a face has fewer than three corners");
  }
  std::vector<Vec3> points;
  for (const std::int64_t v : corners) {
    if (v < 0 || v >= static_cast<std::int64_t>(mesh.vertices.size())) {
      bad_mesh(name,
               "a face names vertex " + std::to_string(v) + " of " + std::to_string(mesh.vertices.size()));
    }
    points.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
  }
  std::string why;
  const auto triangles = triangulate_polygon(points, why);
  if (!triangles) {
    bad_mesh(name, "a face with " + std::to_string(corners.size()) + " corners is no simple polygon: " + why);
  }
  for (const Triangle& t : *triangles) {
    Triangle face;
    std::transform(t.begin(), t.end(), face.begin(), [&](std::int32_t c) {
      return static_cast<std::int32_t>(corners[static_cast<std::size_t>(c)]);
    });
    mesh.triangles.push_back(face);
  }
  return triangles->size();
}

bool TextCursor::next_line() {
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_number_;
    line_ = line_.substr(0, std::min(line_.find('#'), line_.size()));
    if (line_.find_first_not_of(" \t\r") != std::string_view::npos) {
      return true;
    }
  }
  line_ = {};
  return false;
}

std::string_view TextCursor::word() {
  line_.remove_prefix(std::min(line_.find_first_not_of(" \t\r"), line_.size()));
  const std::string_view out = line_.substr(0, std::min(line_.find_first_of(" \t\r"), line_.size()));
  line_.remove_prefix(out.size());
  return out;
}

bool TextCursor::number(double& value) {
  const std::string_view text = word();
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  return end.ec == std::errc() && end.ptr == text.data() + text.size() && std::isfinite(value);
}

bool TextCursor::number(std::int64_t& value) {
  const std::string_view text = word();
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  return end.ec == std::errc() && end.ptr == text.data() + text.size();
}

TriangleMesh parse_off(std::string_view content, const std::string& name) {
  TextCursor text(content);
  const auto fail = [&](const std::string& what) {
    bad_mesh(name, "line " + std::to_string(text.line_number()) + ": " + what);
  };
  text.next_line();
  text.word();  // OFF, COFF …
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
  if (!text.number(vertices)) {
    text.next_line();
    if (!text.number(vertices)) fail("expected the numbers of vertices and faces");
  }
  if (!text.number(faces)) fail("expected the number of faces");
  // A vertex takes at least 6 bytes ("0 0 0\n"), a face 8.
  const auto bytes = static_cast<std::int64_t>(content.size());
  if (vertices < 0 || faces < 0 || vertices > bytes / 6 + 1 || faces > bytes / 8 + 1) {
    fail("the header promises more than the file holds");
  }
  TriangleMesh mesh;
  for (std::int64_t i = 0; i < vertices; ++i) {
    Vec3 p;
    if (!text.next_line()) fail("the file ends before its last vertex");
    if (!text.number(p.x()) || !text.number(p.y()) || !text.number(p.z())) fail("expected three coordinates");
    append_vertex(mesh, p, name);
  }
  std::vector<std::int64_t> corners;
  for (std::int64_t i = 0; i < faces; ++i) {
    std::int64_t count = 0;
    if (!text.next_line()) fail("the file ends before its last face");
    if (!text.number(count) || count < 3 || count > vertices) fail("expected a number of corners");
    corners.resize(static_cast<std::size_t>(count));
    for (auto& corner : corners) {
      if (!text.number(corner)) fail("expected " + std::to_string(count) + " vertex numbers");
    }
    append_face(mesh, corners, name);
  }
  return mesh;
}

TriangleMesh parse_obj(std::string_view content, const std::string& name) {
  TextCursor text(content);
  TriangleMesh mesh;
  std::vector<std::int64_t> corners;
  while (text.next_line()) {
    const std::string at = "line " + std::to_string(text.line_number()) + ": ";
    const std::string_view keyword = text.word();
    if (keyword == "v") {
      Vec3 p;
      if (!text.number(p.x()) || !text.number(p.y()) || !text.number(p.z())) {
        bad_mesh(name, at + "expected three coordinates");
      }
      append_vertex(mesh, p, name);
    } else if (keyword == "f") {
      corners.clear();
      for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
        std::int64_t v = 0;
        const std::string_view digits = word.substr(0, std::min(word.find('/'), word.size()));
        const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), v);
        if (end.ec != std::errc() || end.ptr != digits.data() + digits.size() || v == 0) {
          bad_mesh(name, at + "expected vertex numbers");
        }
        corners.push_back(v > 0 ? v - 1 : static_cast<std::int64_t>(mesh.vertices.size()) + v);
      }
      append_face(mesh, corners, name);
    }
  }
  return mesh;
}

}  // namespace mesh_readers

namespace {

/// No building has a vertex so far from the middle of the others; one in a wrong unit hardly has [m].
constexpr double kFarthest_m = 5e5;

void check_extent(const TriangleMesh& mesh, const std::string& name) {
  Vec3 middle;
  std::vector<double> values(mesh.vertices.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(mesh.vertices.begin(), mesh.vertices.end(), values.begin(),
                   [axis](const Vec3& p) { return p[axis]; });
    const auto median = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), median, values.end());
    middle[axis] = *median;
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const double distance = (mesh.vertices[i] - middle).norm();
    if (distance > kFarthest_m) {
      throw StageError(
          errors::kMeshFormat, name,
          "vertex " + std::to_string(i) + " lies " + std::to_string(std::llround(distance / 1000)) +
              " km from the rest, where no building reaches",
          "correct or delete it; or is the whole file in millimetres? Coordinates count as metres");
    }
  }
}

/// The whole file. What never ends (a device, a pipe) is refused as well as what is too large.
std::string read_bytes(std::ifstream& file, const std::string& name) {
  constexpr std::size_t kLargest = std::size_t{1} << 30U;
  constexpr std::size_t kStep = std::size_t{1} << 20U;
  std::string content;
  do {
    const std::size_t had = content.size();
    content.resize(had + kStep);
    file.read(content.data() + had, static_cast<std::streamsize>(kStep));
    content.resize(had + static_cast<std::size_t>(file.gcount()));
    if (content.size() > kLargest) {
      throw StageError(errors::kMeshFormat, name, "the file is larger than 1 GiB",
                       "a building's surface needs less: give a simplified mesh");
    }
  } while (file);
  return content;
}

}  // namespace

TriangleMesh parse_mesh(std::string_view content, const std::string& name) {
  using namespace mesh_readers;
  TriangleMesh mesh;
  const std::string_view first_line =
      content.substr(0, std::min(content.find_first_of("\r\n"), content.size()));
  if (first_line == "ply") {
    mesh = parse_ply(content, name);
  } else if (first_line.substr(0, 8).find("OFF") != std::string_view::npos) {
    mesh = parse_off(content, name);
  } else if (std::filesystem::path(name).extension() == ".obj") {
    mesh = parse_obj(content, name);
  } else {
    bad_mesh(name, content.empty() ? "the file is empty" : "neither PLY nor OFF nor OBJ");
  }
  if (mesh.triangles.empty()) {
    bad_mesh(name, "there is no face in it");
  }
  check_extent(mesh, name);
  return mesh;
}

TriangleMesh read_mesh(const std::filesystem::path& path) {
  std::error_code problem;
  const bool folder = std::filesystem::is_directory(path, problem);
  std::ifstream file(path, std::ios::binary);
  if (folder || !file) {
    throw StageError(errors::kMeshUnreadable, path.string(), folder ? "is a folder" : "cannot be opened",
                     "check the name and the permission");
  }
  const std::string content = read_bytes(file, path.string());
  if (file.bad()) {
    throw StageError(errors::kMeshUnreadable, path.string(), "cannot be read",
                     "copy it anew: the disk or the network reports an error");
  }
  return parse_mesh(content, path.string());
}

}  // namespace roomcut
