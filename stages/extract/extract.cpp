// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/extract.h"

#include <algorithm>
#include <utility>

#include "common/cells/interfaces.h"
#include "common/errors/codes.h"
#include "stages/extract/build_surface.h"
#include "stages/extract/carry_surfaces.h"
#include "stages/extract/cut_openings.h"
#include "stages/extract/meet_creases.h"

namespace roomcut::extract {

namespace {

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

/// The plan's area of some level faces [m^2].
double area_of(const CellComplex& complex, const std::vector<std::size_t>& level_faces) {
  double area = 0;
  for (const std::size_t face : level_faces) {
    area += complex.area(complex.face_of_level(face));
  }
  return area;
}

void take(const CellComplex& complex, BuiltSurface built, Model& model) {
  model.surface = std::move(built.merged);
  model.areas = built.areas;
  model.empty_m3 = built.empty_m3;
  model.check = built.check;
  model.fault = std::move(built.fault);
  model.put_back_m2 = area_of(complex, built.put_back);
}

}  // namespace

Model extract_model(const CellComplex& complex, const Labels& labels, const std::vector<Opening>& openings,
                    const ExtractParams& params, const LevelSurfaces& surfaces) {
  if (std::none_of(labels.label.begin(), labels.label.end(),
                   [](std::uint8_t l) { return l == Label::kEmpty; })) {
    throw StageError(errors::kEmptyModel, "", "every cell is solid: there is no room to model",
                     "look at the labels' evidence; a smaller graphcut.mu_m lets smaller spaces survive");
  }
  Labels model_labels = labels;
  model_labels.label = labels_of_model(labels.label);
  // Storeys and rooms are those of the closed walls; the surface is that with the openings empty.
  OpenableComplex cut = cut_openings(complex, model_labels, openings);
  LevelSurfaces followed = surfaces;
  follow_planes(complex, model_labels.label, followed);
  LevelSurfaces carried = carry_surfaces(complex, followed, cut);
  const EndHeights heights(cut.complex, carried);
  Storeys storeys = find_storeys(cut.complex, cut.labels.label, params.storeys);
  Model model;
  model.refused = std::move(cut.refused);
  Labels opened = cut.labels;
  open_passages(cut.passages, opened);
  Storeys of_all = storeys;
  for (const Passage& passage : cut.passages) {
    for (const std::size_t cell : passage.cells) {
      of_all.of_cell[cell] = storeys.of_cell[passage.cell_a];
    }
  }
  meet_creases(opened.label, carried, cut.complex);
  take(cut.complex, build_surface(cut.complex, opened.label, of_all, carried), model);
  model.storeys = measure_storeys(heights, cut.labels, storeys);
  const Rooms rooms = find_rooms(heights, cut.labels, storeys);
  model.openings = list_openings(cut.passages, rooms, storeys);
  model.rooms = rooms.spaces;
  model.cell_rooms = rooms_of_whole_cells(model_labels, cut, of_all, rooms);
  measure_unobserved(cut.complex, opened, model);
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
