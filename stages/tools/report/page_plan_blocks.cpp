// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/artefact/h5_list.h"
#include "common/artefact/h5_values.h"
#include "common/cells/cells_io.h"
#include "common/cells/evidence_io.h"
#include "common/slices/slices_io.h"
#include "stages/tools/report/page_blocks.h"

namespace roomcut::report {

namespace {

/// A share 0 … 1 in a byte.
std::uint8_t share(double value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

/// What hough.h5 says of the occupied cells of all slices, in the order of slices.h5.
struct WallCells {
  std::vector<std::uint8_t> boundary;
  std::vector<float> theta;
  std::vector<std::int32_t> line;
};

WallCells read_wall_cells(const StageRun& run) {
  WallCells cells;
  if (run.has_input("hough")) {
    const H5Reader file(run.input("hough"), artefacts::kHough);
    cells.boundary = read_in_range<std::uint8_t>(file, "cells/boundary", {0}, 0, 1);
    const std::uint64_t count = cells.boundary.size();
    cells.theta = read_in_range<float>(file, "cells/theta", {count}, 0, 2 * std::numbers::pi);
    cells.line = file.read<std::int32_t>("cells/line", {count});
  }
  return cells;
}

PageBlock slice_block(const Slices& slices, std::size_t slice, std::size_t first, const WallCells& wall) {
  const OccupancyGrid& grid = slices.wall_slices[slice];
  PageBlockBuilder block("slice-" + std::to_string(slice));
  block.add("ix", grid.ix);
  block.add("iy", grid.iy);
  std::vector<std::uint8_t> coverage, inside;  // inside: where in its cell the points' centroid is
  for (std::size_t i = 0; i < grid.size(); ++i) {
    coverage.push_back(share(grid.coverage[i]));
    inside.push_back(share(static_cast<double>(grid.x[i]) / slices.tau_m - grid.ix[i]));
    inside.push_back(share(static_cast<double>(grid.y[i]) / slices.tau_m - grid.iy[i]));
  }
  block.add("coverage", coverage);
  block.add("inside", inside);
  if (wall.boundary.size() >= first + grid.size()) {
    std::vector<std::uint8_t> theta;
    for (std::size_t i = first; i < first + grid.size(); ++i) {
      theta.push_back(share(static_cast<double>(wall.theta[i]) / std::numbers::pi));
    }
    block.add("boundary", std::span(wall.boundary).subspan(first, grid.size()));
    block.add("line", std::span(wall.line).subspan(first, grid.size()));
    block.add("theta", theta);
  }
  return block.finish();
}

void add_complex(const CellComplex& complex, PageBlockBuilder& block) {
  block.facts["levels"] = complex.levels;
  std::vector<float> vertices;
  for (const Vec2& vertex : complex.vertices) {
    vertices.push_back(static_cast<float>(vertex.x()));
    vertices.push_back(static_cast<float>(vertex.y()));
  }
  block.add("vertices", vertices);
  block.add("face_offset", std::vector<std::int32_t>(complex.face_offset.begin(), complex.face_offset.end()));
  block.add("face_vertex", complex.face_vertex);
  block.add("face_edge", complex.face_edge);
  std::vector<std::int32_t> edges;  // v0, v1, left, right, line of each
  for (const CellComplex::Edge& edge : complex.edges) {
    edges.insert(edges.end(), {edge.v0, edge.v1, edge.left, edge.right, edge.line});
  }
  block.add("edges", edges);
  block.facts["line_ids"] = Json::array();
  for (const CellComplex::Line& line : complex.lines) {
    block.facts["line_ids"].push_back(line.wall_id);
  }
}

void add_weights(const FaceWeights& weights, PageBlockBuilder& block) {
  block.add("wall_omega", weights.wall_omega);
  block.add("wall_left", weights.wall_left);
  block.add("wall_right", weights.wall_right);
  block.add("wall_points", weights.wall_points);
  block.add("level_omega", weights.level_omega);
  block.add("level_floor", weights.level_floor);
  block.add("level_ceiling", weights.level_ceiling);
  block.add("level_points", weights.level_points);
  block.add("cell_points", weights.cell_points);
}

std::vector<float> evidence_of(const H5Reader& file, const DatasetInfo& info) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  const std::string path = "cell/" + info.name;
  if (info.type == "f32") {
    return read_in_range<float>(file, path, info.shape, -kLargest, kLargest);
  }
  const auto values = read_in_range<double>(file, path, info.shape, -kLargest, kLargest);
  return {values.begin(), values.end()};
}

/// Every dataset of data_terms.h5 with one number per cell, whatever it is called: the page shows them with
/// the description that the file itself gives, and with the attribute `weight` where there is one.
void add_evidence(const std::filesystem::path& path, const CellsFile& cells, PageBlockBuilder& block) {
  const H5Reader file = open_for_cells(path, artefacts::kDataTerms, cells);
  block.add("wall_implied", read_in_range<float>(file, "wall/implied", {0}, 0, 1));
  block.add("level_implied", read_in_range<float>(file, "level/implied", {0}, 0, 1));
  block.facts["evidence"] = Json::array();
  for (const DatasetInfo& info : list_datasets(file, "cell")) {
    if (!info.type.starts_with('f') || info.shape != h5::Shape{cells.complex.cells()}) {
      continue;
    }
    Json entry = {{"name", info.name}, {"unit", info.unit}, {"description", info.description}};
    if (const auto weight = info.numbers.find("weight"); weight != info.numbers.end()) {
      entry["weight"] = weight->second;
    }
    block.facts["evidence"].push_back(entry);
    block.add("evidence_" + info.name, evidence_of(file, info));
  }
}

/// As extract found them; before it has run all that is empty is one storey without rooms.
CellRooms rooms_of(const StageRun& run, const std::string& pass, const CellsFile& cells,
                   const Labels& labels) {
  if (pass.empty() && run.has_input("rooms")) {
    return read_rooms(run.input("rooms"), cells);
  }
  CellRooms rooms;
  for (std::size_t cell = 0; cell < cells.complex.cells(); ++cell) {
    rooms.storey.push_back(is_empty(labels.label, cell) ? 0 : -1);
    rooms.room.push_back(-1);
    rooms.unknown_space.push_back(-1);
  }
  return rooms;
}

/// The prefix of the inputs of the second pass, or of the first one when that is all there is.
bool add_cells(const StageRun& run, const std::string& pass, std::vector<PageBlock>& blocks) {
  if (!run.has_input(pass + "cells") || !run.has_input(pass + "weights") || !run.has_input(pass + "terms") ||
      !run.has_input(pass + "labels")) {
    return false;
  }
  const CellsFile cells = read_cells(run.input(pass + "cells"));
  const Labels labels = read_labels(run.input(pass + "labels"), cells);
  PageBlockBuilder block("cells");
  block.facts["pass"] = pass.empty() ? 2 : 1;
  add_complex(cells.complex, block);
  add_weights(read_weights(run.input(pass + "weights"), cells), block);
  add_evidence(run.input(pass + "terms"), cells, block);
  block.add("label", labels.label);
  block.add("margin", labels.margin_m3);
  block.add("unobserved", labels.unobserved);
  const CellRooms rooms = rooms_of(run, pass, cells, labels);
  block.add("storey", rooms.storey);
  block.add("room", rooms.room);
  block.add("unknown_space", rooms.unknown_space);
  block.facts["energy"] = {{"total_m3", labels.energy_m3},
                           {"data_m3", labels.data_m3},
                           {"boundary_m3", labels.boundary_m3},
                           {"repair_flips", labels.repair_flips}};
  const Provenance provenance = read_provenance(run.input(pass + "labels"));
  block.facts["graphcut"] = try_parse_json(provenance.params_json);
  blocks.push_back(block.finish());
  return true;
}

}  // namespace

void add_plan_blocks(const StageRun& run, std::vector<PageBlock>& blocks) {
  if (run.has_input("slices")) {
    const Slices slices = read_slices(run.input("slices"));
    const WallCells wall = read_wall_cells(run);
    std::size_t first = 0;
    for (std::size_t k = 0; k < slices.wall_slices.size(); ++k) {
      blocks.push_back(slice_block(slices, k, first, wall));
      first += slices.wall_slices[k].size();
    }
  }
  if (!add_cells(run, "", blocks)) {
    add_cells(run, "first_", blocks);
  }
}

}  // namespace roomcut::report
