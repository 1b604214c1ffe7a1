// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/cells_io.h"

#include <numbers>
#include <string>

#include "common/artefact/h5_values.h"
#include "common/artefact/json.h"
#include "common/artefact/limits.h"
#include "common/slices/planes_io.h"

// The page of this artefact is schemas/cells.md.

namespace roomcut {

namespace {

/// Text of all lines in one: HDF5 strings of varying length would make the bytes depend on the heap.
struct Names {
  std::vector<std::int64_t> offset{0};
  std::vector<std::uint8_t> bytes;
};

Names names_of(const std::vector<CellComplex::Line>& lines) {
  Names names;
  for (const CellComplex::Line& line : lines) {
    names.bytes.insert(names.bytes.end(), line.wall_id.begin(), line.wall_id.end());
    names.offset.push_back(static_cast<std::int64_t>(names.bytes.size()));
  }
  return names;
}

void write_lines(H5Writer& file, const std::vector<CellComplex::Line>& lines) {
  std::vector<double> theta;
  std::vector<double> d;
  std::vector<double> support;
  std::vector<std::int64_t> layer_offset{0};
  std::vector<std::int32_t> layers;
  for (const CellComplex::Line& line : lines) {
    theta.push_back(line.line.theta);
    d.push_back(line.line.d);
    support.push_back(line.t0);
    support.push_back(line.t1);
    layers.insert(layers.end(), line.layers.begin(), line.layers.end());
    layer_offset.push_back(static_cast<std::int64_t>(layers.size()));
  }
  const Names names = names_of(lines);
  file.write("lines/theta", theta, "rad", "angle of the normal, in [0, pi)");
  file.write("lines/d", d, "m", "distance from the frame's origin along the normal");
  file.write("lines/support", std::span<const double>(support), {lines.size(), 2}, "m",
             "first and last coordinate along the line where points support it");
  file.write("lines/id_offset", names.offset, "1",
             "wall_id of line i = id_bytes[id_offset[i] .. id_offset[i+1])");
  file.write("lines/id_bytes", names.bytes, "1", "UTF-8 text of all wall_ids");
  file.write("lines/layers_offset", layer_offset, "1",
             "layers of line i = layers[layers_offset[i] .. layers_offset[i+1])");
  file.write("lines/layers", layers, "1", "layers where the line may carry a wall; none = all");
  std::vector<std::int32_t> plane;
  plane.reserve(lines.size());
  for (const CellComplex::Line& line : lines) {
    plane.push_back(line.plane);
  }
  file.write("lines/plane", plane, "1",
             "-1 = a wall line; else a crease of this sloped plane, which carries no wall: in its layers "
             "stairs rise");
}

/// Checks that `offset` starts at 0, never falls and ends at `end`.
void check_offsets(const H5Reader& file, const char* path, const std::vector<std::int64_t>& offset,
                   std::size_t end) {
  bool good = !offset.empty() && offset.front() == 0 && offset.back() == static_cast<std::int64_t>(end);
  for (std::size_t i = 1; good && i < offset.size(); ++i) {
    good = offset[i] >= offset[i - 1];
  }
  if (!good) {
    file.damaged(path, "the offsets do not fit the values");
  }
}

std::vector<double> read_metres(const H5Reader& file, const char* path, const h5::Shape& shape) {
  return read_in_range<double>(file, path, shape, -limits::kFarthest_m, limits::kFarthest_m);
}

std::vector<CellComplex::Line> read_lines(const H5Reader& file) {
  const auto theta = read_in_range<double>(file, "lines/theta", {0}, 0, std::numbers::pi);
  const auto d = read_metres(file, "lines/d", {theta.size()});
  const auto support = read_metres(file, "lines/support", {theta.size(), 2});
  const auto id_offset = file.read<std::int64_t>("lines/id_offset", {theta.size() + 1});
  const auto id_bytes = file.read<std::uint8_t>("lines/id_bytes", {0});
  const auto layer_offset = file.read<std::int64_t>("lines/layers_offset", {theta.size() + 1});
  const auto layers = file.read<std::int32_t>("lines/layers", {0});
  std::vector<std::int32_t> plane(theta.size(), -1);
  if (file.exists("lines/plane")) {
    plane = file.read<std::int32_t>("lines/plane", {theta.size()});
  }
  check_offsets(file, "lines/id_offset", id_offset, id_bytes.size());
  check_offsets(file, "lines/layers_offset", layer_offset, layers.size());
  std::vector<CellComplex::Line> lines(theta.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i].wall_id.assign(id_bytes.begin() + id_offset[i], id_bytes.begin() + id_offset[i + 1]);
    if (!is_utf8(lines[i].wall_id)) {
      file.damaged("lines/id_bytes", "a wall_id is no UTF-8 text");
    }
    lines[i].line = {theta[i], d[i]};
    lines[i].t0 = support[2 * i];
    lines[i].t1 = support[2 * i + 1];
    lines[i].layers.assign(layers.begin() + layer_offset[i], layers.begin() + layer_offset[i + 1]);
    lines[i].plane = plane[i];
  }
  return lines;
}

void write_edges(H5Writer& file, const std::vector<CellComplex::Edge>& edges) {
  std::vector<std::int32_t> vertices;
  std::vector<std::int32_t> faces;
  std::vector<std::int32_t> line;
  for (const CellComplex::Edge& edge : edges) {
    vertices.insert(vertices.end(), {edge.v0, edge.v1});
    faces.insert(faces.end(), {edge.left, edge.right});
    line.push_back(edge.line);
  }
  file.write("edges/vertices", std::span<const std::int32_t>(vertices), {edges.size(), 2}, "1",
             "indices of both vertices");
  file.write("edges/faces", std::span<const std::int32_t>(faces), {edges.size(), 2}, "1",
             "faces left and right of first -> second vertex; -1 = beyond the bounding box");
  file.write("edges/line", line, "1", "index of the line it lies on; -1 = side of the bounding box");
}

std::vector<CellComplex::Edge> read_edges(const H5Reader& file) {
  const auto line = file.read<std::int32_t>("edges/line", {0});
  const auto vertices = file.read<std::int32_t>("edges/vertices", {line.size(), 2});
  const auto faces = file.read<std::int32_t>("edges/faces", {line.size(), 2});
  std::vector<CellComplex::Edge> edges(line.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    edges[e] = {vertices[2 * e], vertices[2 * e + 1], faces[2 * e], faces[2 * e + 1], line[e]};
  }
  return edges;
}

}  // namespace

CellsFile read_cells(const std::filesystem::path& path) {
  const H5Reader file(path, artefacts::kCells);
  CellsFile cells;
  CellComplex& complex = cells.complex;
  complex.frame = file.frame();
  complex.levels = read_metres(file, "levels/z", {0});
  const auto xy = read_metres(file, "vertices/xy", {0, 2});
  complex.vertices.resize(xy.size() / 2);
  for (std::size_t v = 0; v < complex.vertices.size(); ++v) {
    complex.vertices[v] = {xy[2 * v], xy[2 * v + 1]};
  }
  complex.face_offset = file.read<std::int64_t>("faces/offset", {0});
  complex.face_vertex = file.read<std::int32_t>("faces/vertex", {0});
  complex.face_edge = file.read<std::int32_t>("faces/edge", {0});
  complex.edges = read_edges(file);
  complex.lines = read_lines(file);
  complex.planes = read_planes(file);
  complex.steps.assign(complex.levels.size(), 0);
  if (file.exists("levels/step")) {
    complex.steps = read_in_range<std::uint8_t>(file, "levels/step", {complex.levels.size()}, 0, 1);
  }
  cells.payload_sha256 = file.payload_sha256();
  const std::string violation = find_violation(complex);
  if (!violation.empty()) {
    file.damaged("/", "no valid cell complex: " + violation);
  }
  return cells;
}

bool write_cells(const std::filesystem::path& path, const CellComplex& complex,
                 const Provenance& provenance) {
  H5Writer file(path, artefacts::kCells, provenance, complex.frame);
  std::vector<double> xy;
  xy.reserve(2 * complex.vertices.size());
  for (const Vec2& p : complex.vertices) {
    xy.insert(xy.end(), {p.x(), p.y()});
  }
  file.write("levels/z", complex.levels, "m",
             "heights of the levels, ascending; layer k lies between levels k and k+1");
  std::vector<std::uint8_t> steps = complex.steps;
  steps.resize(complex.levels.size());
  file.write("levels/step", steps, "1", "1 = stands for sloped planes alone, as stairs would");
  file.write("vertices/xy", std::span<const double>(xy), {complex.vertices.size(), 2}, "m",
             "vertices of the plan");
  file.write("faces/offset", complex.face_offset, "1", "corners of face f = [offset[f] .. offset[f+1])");
  file.write("faces/vertex", complex.face_vertex, "1", "vertex of each corner, counter-clockwise");
  file.write("faces/edge", complex.face_edge, "1", "edge from each corner to the next one");
  write_edges(file, complex.edges);
  write_lines(file, complex.lines);
  write_planes(file, complex.planes);
  return file.commit();
}

}  // namespace roomcut
