// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/evidence_io.h"

// The page of this artefact is schemas/labels.md.

namespace roomcut {

Labels read_labels(const std::filesystem::path& path, const CellsFile& cells) {
  const H5Reader file = open_for_cells(path, artefacts::kLabels, cells);
  const std::size_t count = cells.complex.cells();
  Labels labels;
  labels.label = file.read<std::uint8_t>("cell/label", {count});
  labels.margin_m3 = file.read<float>("cell/margin", {count});
  labels.unobserved = file.read<std::uint8_t>("cell/unobserved", {count});
  check_range(file, "cell/label", labels.label, 0, 2);
  check_range(file, "cell/margin", labels.margin_m3, -1e30, 1e30);
  check_range(file, "cell/unobserved", labels.unobserved, 0, 1);
  labels.energy_m3 = file.attribute_double("/", "energy_m3");
  labels.data_m3 = file.attribute_double("/", "data_m3");
  labels.boundary_m3 = file.attribute_double("/", "boundary_m3");
  labels.repair_flips = file.attribute_int("/", "repair_flips");
  return labels;
}

bool write_labels(const std::filesystem::path& path, const Labels& labels, const CellsFile& cells,
                  const Provenance& provenance) {
  const std::size_t count = cells.complex.cells();
  require_size(labels.label.size(), count, "cell/label");
  require_size(labels.margin_m3.size(), count, "cell/margin");
  require_size(labels.unobserved.size(), count, "cell/unobserved");
  H5Writer file(path, artefacts::kLabels, provenance, cells.complex.frame);
  file.attribute("/", kCellsDigest, cells.payload_sha256);
  file.attribute("/", "energy_m3", labels.energy_m3);
  file.attribute("/", "data_m3", labels.data_m3);
  file.attribute("/", "boundary_m3", labels.boundary_m3);
  file.attribute("/", "repair_flips", labels.repair_flips);
  file.write("cell/label", labels.label, "1",
             "1 = empty (a room's air), 0 = solid, 2 = unknown: neither, out of the model");
  file.write("cell/margin", labels.margin_m3, "m^3", "energy that flipping this cell alone would cost");
  file.write("cell/unobserved", labels.unobserved, "1",
             "1 = too little evidence: labelled, but not to be trusted");
  return file.commit();
}

}  // namespace roomcut
