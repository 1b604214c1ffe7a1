// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/evidence_io.h"

#include <stdexcept>

#include "common/artefact/h5_list.h"
#include "common/artefact/limits.h"
#include "common/errors/codes.h"

// The pages of these artefacts are schemas/weights.md and schemas/data_terms.md.

namespace roomcut {

H5Reader open_for_cells(const std::filesystem::path& path, ArtefactType type, const CellsFile& cells) {
  H5Reader file(path, type);
  if (file.attribute_string("/", kCellsDigest) != cells.payload_sha256) {
    throw StageError(errors::kArtefactMismatch, path.string(),
                     "was made for another cells.h5 than the one given",
                     "rerun the stages after partition, or give files of one and the same pass");
  }
  return file;
}

void require_size(std::size_t actual, std::size_t expected, const char* dataset) {
  if (actual != expected) {
    throw std::logic_error(std::string(dataset) + ": " + std::to_string(actual) + " values for " +
                           std::to_string(expected) + " elements");
  }
}

namespace {

constexpr double kLargestFeature = 1e6;

struct Sizes {
  std::size_t walls, levels, cells;
  explicit Sizes(const CellComplex& complex)
      : walls(complex.layers() * complex.edges.size()),
        levels(complex.levels.size() * complex.faces()),
        cells(complex.cells()) {}
};

std::vector<float> read_share(const H5Reader& file, const char* path, std::size_t count, double low = 0) {
  return read_in_range<float>(file, path, {count}, low, 1);
}

void write_share(H5Writer& file, const char* path, const std::vector<float>& values, std::size_t count,
                 const char* description) {
  require_size(values.size(), count, path);
  file.write(path, values, "1", description);
}

}  // namespace

FaceWeights read_weights(const std::filesystem::path& path, const CellsFile& cells) {
  const H5Reader file = open_for_cells(path, artefacts::kWeights, cells);
  const Sizes sizes(cells.complex);
  FaceWeights weights;
  weights.wall_omega = read_share(file, "wall/omega", sizes.walls);
  weights.wall_left = read_share(file, "wall/left", sizes.walls);
  weights.wall_right = read_share(file, "wall/right", sizes.walls);
  weights.wall_points = file.read<std::uint32_t>("wall/points", {sizes.walls});
  weights.level_omega = read_share(file, "level/omega", sizes.levels);
  weights.level_floor = read_share(file, "level/floor", sizes.levels);
  weights.level_ceiling = read_share(file, "level/ceiling", sizes.levels);
  weights.level_points = file.read<std::uint32_t>("level/points", {sizes.levels});
  weights.cell_points = file.read<std::uint32_t>("cell/points", {sizes.cells});
  weights.cell_slope = read_share(file, "cell/slope", sizes.cells);
  const auto stations = read_in_range<double>(file, "stations/xyz", {0, 3}, -limits::kFarthestOrigin_m,
                                              limits::kFarthestOrigin_m);
  for (std::size_t i = 0; i < stations.size(); i += 3) {
    weights.stations.emplace_back(stations[i], stations[i + 1], stations[i + 2]);
  }
  return weights;
}

bool write_weights(const std::filesystem::path& path, const FaceWeights& weights, const CellsFile& cells,
                   const Provenance& provenance) {
  const Sizes sizes(cells.complex);
  H5Writer file(path, artefacts::kWeights, provenance, cells.complex.frame);
  file.attribute("/", kCellsDigest, cells.payload_sha256);
  write_share(file, "wall/omega", weights.wall_omega, sizes.walls,
              "density-corrected covered share of the wall face");
  write_share(file, "wall/left", weights.wall_left, sizes.walls,
              "share of the coverage that speaks for empty space left of the edge");
  write_share(file, "wall/right", weights.wall_right, sizes.walls,
              "share of the coverage that speaks for empty space right of the edge");
  require_size(weights.wall_points.size(), sizes.walls, "wall/points");
  file.write("wall/points", weights.wall_points, "1", "points counted on the wall face");
  write_share(file, "level/omega", weights.level_omega, sizes.levels,
              "covered share by any horizontal surface");
  write_share(file, "level/floor", weights.level_floor, sizes.levels,
              "covered share by floor surface (empty above)");
  write_share(file, "level/ceiling", weights.level_ceiling, sizes.levels,
              "covered share by ceiling surface (empty below)");
  require_size(weights.level_points.size(), sizes.levels, "level/points");
  file.write("level/points", weights.level_points, "1", "points counted on the level face");
  require_size(weights.cell_points.size(), sizes.cells, "cell/points");
  file.write("cell/points", weights.cell_points, "1", "points strictly inside the cell, away from its faces");
  write_share(file, "cell/slope", weights.cell_slope, sizes.cells,
              "share of the cell's plan over which a sloped surface passes through the cell");
  std::vector<double> stations;
  for (const Vec3& station : weights.stations) {
    stations.insert(stations.end(), {station.x(), station.y(), station.z()});
  }
  file.write("stations/xyz", std::span<const double>(stations), {weights.stations.size(), 3}, "m",
             "scanner positions, where the scan names them");
  return file.commit();
}

namespace {

/// The datasets of `cell` with a weight are the features: whichever there are.
DataTerms read_features(const H5Reader& file, std::size_t count) {
  DataTerms terms;
  terms.constant = file.attribute_double("cell", "constant");
  terms.weights_source = file.attribute_string("cell", "weights_source");
  for (const DatasetInfo& info : list_datasets(file, "cell")) {
    if (const auto weight = info.numbers.find("weight"); weight != info.numbers.end()) {
      const std::string path = "cell/" + info.name;
      terms.features.push_back(
          {info.name, weight->second, info.description,
           read_in_range<float>(file, path, {count}, -kLargestFeature, kLargestFeature)});
    }
  }
  return terms;
}

void write_features(H5Writer& file, const DataTerms& terms, std::size_t count) {
  for (const CellFeature& feature : terms.features) {
    const std::string path = "cell/" + feature.name;
    require_size(feature.value.size(), count, path.c_str());
    file.write(path, feature.value, "1", feature.meaning);
    file.attribute(path, "weight", feature.weight);
  }
  file.attribute("cell", "constant", terms.constant);
  file.attribute("cell", "weights_source", terms.weights_source);
}

}  // namespace

DataTerms read_data_terms(const std::filesystem::path& path, const CellsFile& cells) {
  const H5Reader file = open_for_cells(path, artefacts::kDataTerms, cells);
  const std::size_t count = cells.complex.cells();
  DataTerms terms = read_features(file, count);
  terms.kappa = read_share(file, "cell/kappa", count);
  terms.vertical = read_share(file, "cell/vertical", count, -1);
  terms.around = read_share(file, "cell/around", count, -1);
  terms.winding = file.read<float>("cell/winding", {count});
  terms.surface_m2 = file.read<float>("cell/surface", {count});
  check_range(file, "cell/winding", terms.winding, -1e6, 1e6);
  check_range(file, "cell/surface", terms.surface_m2, -1e12, 1e12);
  terms.thin = read_share(file, "cell/thin", count);
  terms.line_of_sight = read_share(file, "cell/line_of_sight", count);
  terms.observed = read_share(file, "cell/observed", count);
  terms.closed = read_share(file, "cell/closed", count);
  terms.beta = read_share(file, "cell/beta", count);
  const Sizes sizes(cells.complex);
  terms.wall_implied = read_share(file, "wall/implied", sizes.walls);
  terms.level_implied = read_share(file, "level/implied", sizes.levels);
  terms.d_empty = file.read<double>("cell/d_empty", {count});
  terms.d_solid = file.read<double>("cell/d_solid", {count});
  check_range(file, "cell/d_empty", terms.d_empty, 0, 1e15);
  check_range(file, "cell/d_solid", terms.d_solid, 0, 1e15);
  return terms;
}

bool write_data_terms(const std::filesystem::path& path, const DataTerms& terms, const CellsFile& cells,
                      const Provenance& provenance) {
  const std::size_t count = cells.complex.cells();
  H5Writer file(path, artefacts::kDataTerms, provenance, cells.complex.frame);
  file.attribute("/", kCellsDigest, cells.payload_sha256);
  write_share(file, "cell/kappa", terms.kappa, count, "share of the rays with an odd number of crossings");
  write_share(file, "cell/vertical", terms.vertical, count,
              "nearest permanent face straight up and down: +1 empty ... -1 solid");
  write_share(file, "cell/around", terms.around, count, "the same along the rays: +1 empty ... -1 solid");
  require_size(terms.winding.size(), count, "cell/winding");
  file.write("cell/winding", terms.winding, "1",
             "mean over the rays of the signed crossings: 1 inside, 0 outside");
  require_size(terms.surface_m2.size(), count, "cell/surface");
  file.write("cell/surface", terms.surface_m2, "m^2",
             "covered area of the cell's own faces: + where it faces the cell, - where it turns its back");
  write_share(file, "cell/thin", terms.thin, count, "how far the cell is as thin as walls and slabs are");
  write_share(file, "cell/line_of_sight", terms.line_of_sight, count,
              "share of the cell that the scanners looked through; 0 where no position is known");
  write_share(file, "cell/observed", terms.observed, count, "share of the rays that end on a seen face");
  write_share(file, "cell/closed", terms.closed, count, "share of the level rays that end on a seen face");
  write_share(file, "cell/beta", terms.beta, count, "probability that the cell is empty");
  require_size(terms.d_empty.size(), count, "cell/d_empty");
  require_size(terms.d_solid.size(), count, "cell/d_solid");
  file.write("cell/d_empty", terms.d_empty, "m^3",
             "cost of the label empty: volume x (1 - beta) + what its own faces' backs add");
  file.write("cell/d_solid", terms.d_solid, "m^3",
             "cost of the label solid: volume x beta + what its own faces' fronts add");
  write_features(file, terms, count);
  const Sizes sizes(cells.complex);
  write_share(file, "wall/implied", terms.wall_implied, sizes.walls,
              "how far the wall face is the unseen other side of a wall that was seen");
  write_share(file, "level/implied", terms.level_implied, sizes.levels,
              "how far the level face is the unseen other side of a slab that was seen");
  return file.commit();
}

}  // namespace roomcut
