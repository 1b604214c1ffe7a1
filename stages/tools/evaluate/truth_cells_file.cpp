// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/evidence_io.h"
#include "stages/tools/evaluate/evaluate_io.h"

namespace roomcut::evaluate {

void write_truth_cells(const std::filesystem::path& path, const Explanation& explanation,
                       const LabelledCells& cells, const Provenance& provenance) {
  const std::size_t count = cells.complex.cells();
  require_size(explanation.cell_m3.size(), count, "cell/sampled");
  require_size(explanation.cell_truth_m3.size(), count, "cell/empty");
  H5Writer file(path, artefacts::kTruthCells, provenance, cells.complex.frame);
  file.attribute("/", kCellsDigest, cells.payload_sha256);
  file.write("cell/sampled", explanation.cell_m3, "m^3",
             "volume of the cell, as sampled by vertical lines; 0: none meets it");
  file.write("cell/empty", explanation.cell_truth_m3, "m^3", "the part of it that is empty in the truth");
  file.commit();
}

}  // namespace roomcut::evaluate
