// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 artefacts: edits of a sound one (hdf5_edits.h) are read, and used as the next stage uses them where
// that is quick.
#include <array>

#include "common/artefact/h5.h"
#include "common/cells/cells_io.h"
#include "common/cells/surfaces_io.h"
#include "common/cloud/cloud_io.h"
#include "common/slices/slices_io.h"
#include "stages/detect_lines/detect_lines.h"
#include "stages/slice/slice.h"
#include "tests/fuzz/hdf5_edits.h"
#include "tests/fuzz/target.h"

namespace roomcut::fuzz {
using namespace roomcut::detect_lines;
using namespace roomcut::slice;

namespace {

constexpr const char *kCloud = "10_ingest/cloud.h5", *kSlices = "20_slice/slices.h5",
                     *kHough = "30_detect_lines/hough.h5", *kCells = "50_partition/cells.h5",
                     *kWeights = "55_weigh_faces/weights.h5", *kTerms = "60_raycast/data_terms.h5",
                     *kLabels = "70_graphcut/labels.h5", *kFinalCells = "90_final/cells.h5",
                     *kSurfaces = "92_fit_surfaces/surfaces.h5", *kRooms = "rooms.h5";

const CellsFile& seed_cells() {
  static const CellsFile kFile = read_cells(seeds() / kCells);
  return kFile;
}

void cloud(std::string_view edits) {
  const PrivateFile file(edited_artefact(kCloud, edits), ".h5");
  const CloudReader reader(file.path());
  const TileSource tiles = [&](const TileVisitor& visit) { reader.for_each_tile(visit, {}); };
  slice_cloud(reader.header(), tiles, SliceParams{});
}

void slices(std::string_view edits) {
  const PrivateFile file(edited_artefact(kSlices, edits), ".h5");
  DetectLinesParams coarse;  // a small accumulator: more turns a second
  coarse.hough_angle_deg = 2;
  coarse.hough_distance_m = 0.05;
  detect_lines::detect_lines(read_slices(file.path()), coarse);
}

/// The datasets that the report reads (stages/tools/report/page_plan_blocks.cpp).
void hough(std::string_view edits) {
  const PrivateFile file(edited_artefact(kHough, edits), ".h5");
  const H5Reader reader(file.path(), artefacts::kHough);
  const std::uint64_t count = reader.read<std::uint8_t>("cells/boundary", {0}).size();
  reader.read<float>("cells/theta", {count});
  reader.read<std::int32_t>("cells/line", {count});
}

void cells(std::string_view edits) {
  const PrivateFile file(edited_artefact(kCells, edits), ".h5");
  read_cells(file.path());
}

void weights(std::string_view edits) {
  const PrivateFile file(edited_artefact(kWeights, edits), ".h5");
  read_weights(file.path(), seed_cells());
}

void data_terms(std::string_view edits) {
  const PrivateFile file(edited_artefact(kTerms, edits), ".h5");
  read_data_terms(file.path(), seed_cells());
}

void labels(std::string_view edits) {
  const PrivateFile file(edited_artefact(kLabels, edits), ".h5");
  read_labels(file.path(), seed_cells());
}

const CellsFile& seed_final_cells() {
  static const CellsFile kFile = read_cells(seeds() / kFinalCells);
  return kFile;
}

void surfaces(std::string_view edits) {
  const PrivateFile file(edited_artefact(kSurfaces, edits), ".h5");
  read_surfaces(file.path(), seed_final_cells());
}

void rooms(std::string_view edits) {
  const PrivateFile file(edited_artefact(kRooms, edits), ".h5");
  read_rooms(file.path(), seed_final_cells());
}

/// The bytes of the container as they come: every artefact is read through one parser. What follows is what
/// the inspecting programs do, and a reader of the type that the first seeds have.
void hdf5(std::string_view bytes) {
  const PrivateFile file(bytes, ".h5");
  const InputRecord stated = inspect_artefact(file.path());
  if (stated.artefact == artefacts::kLabels.name) {
    read_labels(file.path(), seed_cells());
  }
  verified_plain_artefact(file.path());
  read_provenance(file.path());
}

constexpr std::array kTargets{Target{"hdf5", Mutation::kBytes, hdf5, kLabels},
                              Target{"cloud", Mutation::kHdf5Edits, cloud, kCloud},
                              Target{"slices", Mutation::kHdf5Edits, slices, kSlices},
                              Target{"hough", Mutation::kHdf5Edits, hough, kHough},
                              Target{"cells", Mutation::kHdf5Edits, cells, kCells},
                              Target{"weights", Mutation::kHdf5Edits, weights, kWeights},
                              Target{"data_terms", Mutation::kHdf5Edits, data_terms, kTerms},
                              Target{"labels", Mutation::kHdf5Edits, labels, kLabels},
                              Target{"surfaces", Mutation::kHdf5Edits, surfaces, kSurfaces},
                              Target{"rooms", Mutation::kHdf5Edits, rooms, kRooms}};

}  // namespace

std::span<const Target> hdf5_targets() {
  return kTargets;
}

}  // namespace roomcut::fuzz
