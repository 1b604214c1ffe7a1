// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/report/pass_pictures.h"

#include "common/cells/cells_io.h"
#include "common/cells/surfaces_io.h"
#include "common/openings/openings_io.h"

namespace roomcut::report {

namespace {

constexpr double kThinLayer_m = 0.5;

/// The layers of some height; with labels only those that hold something empty.
std::vector<std::size_t> shown_layers(const CellComplex& complex, const Labels* labels) {
  std::vector<std::size_t> layers;
  for (std::size_t k = 0; k < complex.layers(); ++k) {
    bool any = labels == nullptr;
    for (std::size_t f = 0; !any && f < complex.faces(); ++f) {
      any = is_empty(labels->label, complex.cell(f, k));
    }
    if (any && complex.height(k) > kThinLayer_m) {
      layers.push_back(k);
    }
  }
  return layers;
}

}  // namespace

void draw_partition_of(const StageRun& run, const PassInputs& inputs, const std::string& stage,
                       std::vector<Picture>& pictures) {
  pictures.push_back(draw_partition(stage, read_cells(run.input(inputs.cells)).complex));
}

void draw_weights_of(const StageRun& run, const PassInputs& inputs, const std::string& stage,
                     std::vector<Picture>& pictures) {
  const CellsFile cells = read_cells(run.input(inputs.cells));
  const FaceWeights weights = read_weights(run.input(inputs.weights), cells);
  for (const std::size_t k : shown_layers(cells.complex, nullptr)) {
    pictures.push_back(draw_weights(stage, cells.complex, weights, k));
  }
}

void draw_evidence_of(const StageRun& run, const PassInputs& inputs, const std::string& stage,
                      std::vector<Picture>& pictures) {
  const CellsFile cells = read_cells(run.input(inputs.cells));
  const DataTerms terms = read_data_terms(run.input(inputs.terms), cells);
  for (const std::size_t k : shown_layers(cells.complex, nullptr)) {
    pictures.push_back(draw_evidence(stage, cells.complex, terms, k));
  }
}

void draw_labels_of(const StageRun& run, const PassInputs& inputs, const std::string& stage,
                    std::vector<Picture>& pictures) {
  const CellsFile cells = read_cells(run.input(inputs.cells));
  const DataTerms terms = read_data_terms(run.input(inputs.terms), cells);
  const Labels labels = read_labels(run.input(inputs.labels), cells);
  for (const std::size_t k : shown_layers(cells.complex, &labels)) {
    pictures.push_back(draw_cells(stage, cells.complex, terms, labels, k));
  }
}

void draw_openings_of(const StageRun& run, const PassInputs& inputs, std::vector<Picture>& pictures) {
  const CellsFile cells = read_cells(run.input(inputs.cells));
  const Labels labels = read_labels(run.input(inputs.labels), cells);
  const Openings openings = read_openings(run.input("openings"), cells.payload_sha256).content;
  for (const std::size_t k : shown_layers(cells.complex, &labels)) {
    pictures.push_back(draw_openings("find_openings", cells.complex, labels, openings.openings, k));
  }
}

void draw_surfaces_of(const StageRun& run, const PassInputs& inputs, std::vector<Picture>& pictures) {
  const CellsFile cells = read_cells(run.input(inputs.cells));
  const LevelSurfaces surfaces = read_surfaces(run.input("surfaces"), cells);
  for (std::size_t level = 0; level < cells.complex.levels.size(); ++level) {
    bool any = false;
    for (std::size_t f = 0; !any && f < cells.complex.faces(); ++f) {
      any = surfaces.of_face[cells.complex.level_face(f, level)] >= 0;
    }
    if (any) {
      pictures.push_back(draw_surfaces("fit_surfaces", cells.complex, surfaces, level));
    }
  }
}

}  // namespace roomcut::report
