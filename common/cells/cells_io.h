// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "common/artefact/provenance.h"
#include "common/cells/cell_complex.h"

namespace roomcut {

// Readers and writers of cells.h5, weights.h5, data_terms.h5, labels.h5 and rooms.h5. Errors: kArtefact…
// (common/artefact/h5.h). All but the first store the payload digest of the cells.h5 they belong
// to; a reader that is given the complex and its digest refuses files of another complex with
// kArtefactMismatch ("rerun …"). Writers return whether the payload is new.

struct CellsFile {
  CellComplex complex;
  std::string payload_sha256;
};

CellsFile read_cells(const std::filesystem::path& path);
bool write_cells(const std::filesystem::path& path, const CellComplex& complex, const Provenance& provenance);

FaceWeights read_weights(const std::filesystem::path& path, const CellsFile& cells);
bool write_weights(const std::filesystem::path& path, const FaceWeights& weights, const CellsFile& cells,
                   const Provenance& provenance);

DataTerms read_data_terms(const std::filesystem::path& path, const CellsFile& cells);
bool write_data_terms(const std::filesystem::path& path, const DataTerms& terms, const CellsFile& cells,
                      const Provenance& provenance);

Labels read_labels(const std::filesystem::path& path, const CellsFile& cells);
bool write_labels(const std::filesystem::path& path, const Labels& labels, const CellsFile& cells,
                  const Provenance& provenance);

CellRooms read_rooms(const std::filesystem::path& path, const CellsFile& cells);
bool write_rooms(const std::filesystem::path& path, const CellRooms& rooms, const CellsFile& cells,
                 const Provenance& provenance);

}  // namespace roomcut
