// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/extract.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "common/cells/interfaces.h"
#include "common/errors/codes.h"
#include "stages/extract/cell_surface.h"
#include "stages/extract/cut_openings.h"

namespace roomcut::extract {

namespace {

SurfaceAreas measure_areas(const TriangleMesh& mesh) {
  SurfaceAreas areas;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto kind = static_cast<SurfaceKind>(mesh.kind[t]);
    double& sum = kind == SurfaceKind::kFloor     ? areas.floor
                  : kind == SurfaceKind::kCeiling ? areas.ceiling
                                                  : areas.wall;
    sum += triangle_area(mesh, t);
  }
  return areas;
}

/// The facets enclose just the empty cells. Merged, they do but for the vertices of one wall, which lie
/// within kPlanSnap_m of its line, not on it: which of them a triangle joins moves its surface by less than
/// that.
std::string volume_fault(double mesh_m3, double facets_m3, const Model& model) {
  constexpr double kRounding = 1e-9;
  const double rounding = kRounding * model.empty_m3;
  const double snap = kPlanSnap_m * model.areas.wall;
  if (std::abs(facets_m3 - model.empty_m3) <= rounding && std::abs(mesh_m3 - facets_m3) <= rounding + snap) {
    return "";
  }
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(),
                "its volume is %.9f m3, that of its facets %.9f m3, but the empty cells have %.9f m3",
                mesh_m3, facets_m3, model.empty_m3);
  return text.data();
}

void measure_unobserved(const CellComplex& complex, const Labels& labels, Model& model) {
  for (std::size_t face = 0; face < complex.faces(); ++face) {
    const double area = complex.area(face);
    for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
      const std::size_t cell = complex.cell(face, layer);
      if (labels.unobserved[cell] != 0) {
        const bool empty = is_empty(labels.label, cell);
        (empty ? model.unobserved_empty_m3 : model.unobserved_solid_m3) += area * complex.height(layer);
      }
    }
  }
}

std::vector<ModelOpening> list_openings(const std::vector<Passage>& passages, const Rooms& rooms,
                                        const Storeys& storeys) {
  std::vector<ModelOpening> list;
  list.reserve(passages.size());
  for (const Passage& passage : passages) {
    list.push_back({passage.opening, rooms.of_cell[passage.cell_a], rooms.of_cell[passage.cell_b],
                    storeys.of_cell[passage.cell_a], passage.volume_m3});
  }
  return list;
}

/// Brings storeys and rooms of the refined cells back to those that they are parts of.
CellRooms rooms_of_whole_cells(const Labels& labels, const OpenableComplex& cut, const Storeys& storeys,
                               const Rooms& rooms) {
  CellRooms out;
  out.storey.assign(labels.label.size(), -1);
  out.room.assign(labels.label.size(), -1);
  out.unknown_space.assign(labels.label.size(), -1);
  std::vector<std::pair<bool, double>> best(labels.label.size());  // whether it lies in a room, volume
  for (std::size_t layer = 0; layer < cut.complex.layers(); ++layer) {
    for (std::size_t face = 0; face < cut.complex.faces(); ++face) {
      const std::size_t part = cut.complex.cell(face, layer);
      const std::size_t whole = cut.whole[part];
      const std::pair<bool, double> weight(rooms.of_cell[part] >= 0,
                                           cut.complex.area(face) * cut.complex.height(layer));
      if (is_empty(labels.label, whole) && storeys.of_cell[part] >= 0 && weight > best[whole]) {
        best[whole] = weight;
        out.storey[whole] = storeys.of_cell[part];
        out.room[whole] = rooms.of_cell[part];
      }
    }
  }
  return out;
}

}  // namespace

Model extract_model(const CellComplex& complex, const Labels& labels, const std::vector<Opening>& openings,
                    const ExtractParams& params) {
  if (!(empty_volume(complex, labels.label) > 0)) {
    throw StageError(errors::kEmptyModel, "", "every cell is solid: there is no room to model",
                     "look at the labels' evidence; a smaller graphcut.mu_m lets smaller spaces survive");
  }
  Labels model_labels = labels;
  model_labels.label = labels_of_model(labels.label);
  // Storeys and rooms are those of the closed walls; then the openings become empty.
  OpenableComplex cut = cut_openings(complex, model_labels, openings);
  Storeys storeys = find_storeys(cut.complex, cut.labels.label, params.storeys);
  Model model;
  model.refused = std::move(cut.refused);
  model.storeys = measure_storeys(cut.complex, cut.labels, storeys);
  const Rooms rooms = find_rooms(cut.complex, cut.labels, storeys);
  model.openings = list_openings(cut.passages, rooms, storeys);
  model.rooms = rooms.spaces;
  open_passages(cut.passages, cut.labels);
  for (std::size_t i = 0; i < cut.passages.size(); ++i) {
    for (const std::size_t cell : cut.passages[i].cells) {
      storeys.of_cell[cell] = static_cast<std::int16_t>(model.openings[i].storey);
    }
  }
  model.cell_rooms = rooms_of_whole_cells(model_labels, cut, storeys, rooms);
  model.empty_m3 = empty_volume(cut.complex, cut.labels.label);
  const FacetSurface facets = surface_of_labels(cut.complex, cut.labels.label, storeys);
  model.surface = merge_facets(facets);
  model.areas = measure_areas(model.surface.mesh);
  measure_unobserved(cut.complex, cut.labels, model);
  model.check = check_mesh(model.surface.mesh);
  model.fault = model.surface.fault;
  for (const std::string& more :
       {describe_faults(model.check), volume_fault(model.check.volume_m3, volume(facets), model)}) {
    if (!more.empty()) {
      model.fault += (model.fault.empty() ? "" : "; ") + more;
    }
  }
  return model;
}

void list_unknown_spaces(const CellComplex& complex, const Labels& labels, const FaceWeights& weights,
                         const DataTerms& terms, const ExtractParams& params, Model& model) {
  UnknownSpaces unknown =
      find_unknown_spaces(complex, labels, weights, terms, model.cell_rooms, model.storeys, params.storeys);
  model.unknown_spaces = std::move(unknown.spaces);
  model.cell_rooms.unknown_space = std::move(unknown.of_cell);
}

}  // namespace roomcut::extract
