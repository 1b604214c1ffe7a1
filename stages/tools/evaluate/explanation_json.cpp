// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdio>

#include "common/artefact/json_values.h"
#include "common/cells/cells_io.h"
#include "common/cells/surfaces_io.h"
#include "common/geometry/level_turn.h"
#include "stages/tools/evaluate/evaluate_io.h"

namespace roomcut::evaluate {

namespace {

Json causes_json(const std::array<double, kCauses>& m3) {
  Json out = Json::object();
  for (std::size_t cause = 0; cause < kCauses; ++cause) {
    out[kCauseNames[cause]] = m3[cause];
  }
  return out;
}

Json evidence_json(const Explanation::Evidence& e) {
  return {{"cells", e.cells},
          {"volume_m3", e.volume_m3},
          {"labelled_empty", e.volume_m3 > 0 ? Json(e.empty_m3 / e.volume_m3) : Json(nullptr)},
          {"evidence_m3", e.evidence_m3},
          {"beta", e.beta},
          {"observed", e.observed}};
}

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 256> text;
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

std::string evidence_text(const Explanation::Evidence& e) {
  return format("%zu cells of %.2f m3, evidence for empty %+.2f m3, beta %.2f, observed %.2f", e.cells,
                e.volume_m3, e.evidence_m3, e.beta, e.observed);
}

}  // namespace

LabelledCells read_labelled_cells(const std::filesystem::path& cells, const std::filesystem::path& labels,
                                  const std::filesystem::path& terms, const std::filesystem::path& surfaces,
                                  ComparedAxes& axes) {
  const CellsFile file = read_cells(cells);
  LabelledCells out;
  out.label = read_labels(labels, file).label;
  out.payload_sha256 = file.payload_sha256;
  if (!terms.empty()) {
    out.terms = read_data_terms(terms, file);
  }
  axes.turn = level_turn(file.complex.frame.level);
  const double* local = file.complex.frame.origin;
  const Vec3 by = axes.from_file(Vec3(local[0], local[1], local[2]));
  out.complex = moved(file.complex, by);
  if (!surfaces.empty()) {
    out.surfaces = moved(read_surfaces(surfaces, file), by);
  }
  return out;
}

Json explanation_json(const Explanation& explanation, const Scores& scores) {
  Json rooms = Json::array();
  for (std::size_t i = 0; i < explanation.rooms.size(); ++i) {
    const Explanation::Room& room = explanation.rooms[i];
    Json entry = evidence_json(room.own);
    entry["name"] = scores.rooms[i].room.name;
    entry["found"] = scores.rooms[i].found();
    entry["own_share"] = room.volume_m3 > 0 ? Json(room.own_m3 / room.volume_m3) : Json(nullptr);
    rooms.push_back(std::move(entry));
  }
  Json walls = Json::array();
  for (const Explanation::LostWall& wall : explanation.lost_walls) {
    Json entry = evidence_json(wall.cells);
    entry["rooms"] = {wall.a, wall.b};
    entry["area_m2"] = wall.area_m2;
    entry["no_cell_m2"] = wall.no_cell_m2;
    entry["slab"] = wall.slab;
    entry["wall_ids"] = wall.wall_ids;
    walls.push_back(std::move(entry));
  }
  Json invented = Json::array();
  for (const Explanation::InventedSpace& space : explanation.invented) {
    invented.push_back(
        {{"centre", {space.centre.x(), space.centre.y(), space.centre.z()}}, {"volume_m3", space.volume_m3}});
  }
  return {{"bound_iou", explanation.bound_iou},
          {"labels_iou", explanation.labels_iou},
          {"empty_m3", explanation.empty_m3},
          {"lost_m3", causes_json(explanation.lost_m3)},
          {"extra_m3", causes_json(explanation.extra_m3)},
          {"rooms", rooms},
          {"lost_walls", walls},
          {"invented_m3", explanation.invented_m3()},
          {"invented", invented}};
}

std::string explanation_rows(const Explanation& explanation, const Scores& scores) {
  std::string text = format("upper bound       IoU %.4f with the truth's labels on these cells (now %.4f)\n",
                            explanation.bound_iou, explanation.labels_iou);
  text += "wrong because of      lost m3    extra m3\n";
  for (std::size_t cause = 0; cause < kCauses; ++cause) {
    text += format("  %-16s %10.3f  %10.3f\n", kCauseNames[cause], explanation.lost_m3[cause],
                   explanation.extra_m3[cause]);
  }
  for (std::size_t i = 0; i < explanation.rooms.size(); ++i) {
    const Explanation::Room& room = explanation.rooms[i];
    if (!scores.rooms[i].found()) {
      text += "  missed          " + scores.rooms[i].room.name +
              format(": %.0f %% has cells of its own: ", 100 * room.own_m3 / std::max(room.volume_m3, 1e-9)) +
              evidence_text(room.own) + "\n";
    }
  }
  for (const Explanation::InventedSpace& space : explanation.invented) {
    text += format("  invented space  %.1f m3 around (%.1f, %.1f, %.1f)\n", space.volume_m3, space.centre.x(),
                   space.centre.y(), space.centre.z());
  }
  for (const Explanation::LostWall& wall : explanation.lost_walls) {
    text += wall.slab ? "  lost slab       " : "  lost wall       ";
    text += scores.rooms[static_cast<std::size_t>(wall.a)].room.name + " | " +
            scores.rooms[static_cast<std::size_t>(wall.b)].room.name +
            format(": %.1f m2, %.1f m2 of it without a cell; ", wall.area_m2, wall.no_cell_m2) +
            evidence_text(wall.cells);
    for (const std::string& id : wall.wall_ids) {
      text += " " + id;
    }
    text += "\n";
  }
  return text;
}

}  // namespace roomcut::evaluate
