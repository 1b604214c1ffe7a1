// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/artefact/json.h"
#include "common/artefact/provenance.h"
#include "stages/tools/evaluate/distance_colours.h"
#include "stages/tools/evaluate/evaluate.h"

namespace roomcut::evaluate {

/// Of a truth.json, brought into `axes`: the `rooms`: name, floor, ceiling, either `polygon` ([[x, y], …]) or
/// a point in it (`center`), and optionally `scanned`; optionally `ignore_boxes`: [[lower corner], [upper
/// corner]] each, `columns`, `niches` and `arcs` (schemas/truth.md). Other members are ignored. Throws
/// StageError(kMeshFormat) for what is not that.
TruthDescription read_truth_description(const std::filesystem::path& path, const ComparedAxes& axes);

/// The curved walls that a model's summary.json names, brought into `axes`. Throws StageError(kMeshFormat).
std::vector<DescribedArc> read_curved_walls(const std::filesystem::path& path, const ComparedAxes& axes);

/// The cells, labels and, if given, data terms and surfaces of one pass, brought into `axes`, whose turn
/// becomes that of the cells: their faces stay upright and level. Errors as in cells_io.h.
LabelledCells read_labelled_cells(const std::filesystem::path& cells, const std::filesystem::path& labels,
                                  const std::filesystem::path& terms, const std::filesystem::path& surfaces,
                                  ComparedAxes& axes);

/// Where the points of a cloud.h5 lie. Errors as in cloud_io.h.
ScannedSurface read_scanned_surface(const std::filesystem::path& path, const ComparedAxes& axes);

/// The member `explanation` of scores.json, and its rows in the table.
Json explanation_json(const Explanation& explanation, const Scores& scores);
std::string explanation_rows(const Explanation& explanation, const Scores& scores);

/// truth_cells.h5 (schemas/truth_cells.md): how much of every cell is empty in the truth. `explanation` is
/// that of `cells`.
void write_truth_cells(const std::filesystem::path& path, const Explanation& explanation,
                       const LabelledCells& cells, const Provenance& provenance);

/// scores.json (schemas/scores.md).
void write_scores(const std::filesystem::path& path, const Scores& scores, const Provenance& provenance);

/// What is printed: one compact table.
std::string scores_table(const Scores& scores);

/// distance.ply: vertices coloured from 0 (dark) to `range_m` and beyond (bright), and the distance itself.
void write_distance_ply(const std::filesystem::path& path, const DistanceMesh& mesh, const ComparedAxes& axes,
                        double range_m);
/// distance.png: the same seen from above at an angle, looking into the rooms.
void write_distance_png(const std::filesystem::path& path, const DistanceMesh& mesh, double range_m);

}  // namespace roomcut::evaluate
