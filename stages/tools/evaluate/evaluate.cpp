// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/evaluate.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/cells/face_locator.h"
#include "common/errors/codes.h"

namespace roomcut::evaluate {

namespace {

constexpr double kAutoSamples = 250000;
constexpr std::uint64_t kModelSeed = 1, kTruthSeed = 2, kColumnSeed = 3;

/// Bounds what a surface of long, thin triangles costs, or one of another unit; buildings stay far below.
constexpr double kMostSamples = 1e6;
/// Where the user chose the spacing: some 2 GB.
constexpr double kMostChosenSamples = 2e7;

double auto_spacing(double area_m2) {
  return std::clamp(std::sqrt(area_m2 / kAutoSamples), 0.002, 0.5);
}

double column_spacing(const std::optional<double>& chosen, double area_m2) {
  const double most = chosen ? kMostChosenSamples : kMostSamples;
  const double spacing = chosen.value_or(std::max(auto_spacing(area_m2), std::sqrt(area_m2 / most)));
  if (area_m2 > most * spacing * spacing * 1.01) {
    throw StageError(
        errors::kTooComplex, "column_spacing_m",
        "that are more than 20 million vertical lines through " + std::to_string(area_m2) + " m^2",
        "choose a larger spacing, or auto");
  }
  return spacing;
}

/// One spacing for both surfaces.
double sample_spacing(const std::optional<double>& chosen, const TriangleMesh& model,
                      const TriangleMesh& truth, double truth_m2) {
  if (!chosen) {
    return affordable_spacing(model, affordable_spacing(truth, auto_spacing(truth_m2), kMostSamples),
                              kMostSamples);
  }
  for (const TriangleMesh* mesh : {&model, &truth}) {
    const double enough = affordable_spacing(*mesh, *chosen, kMostChosenSamples);
    if (enough > *chosen) {
      throw StageError(errors::kTooComplex, "sample_spacing_m",
                       "that are more than 20 million samples of one surface",
                       "choose " + std::to_string(enough) + " or more, or auto");
    }
  }
  return *chosen;
}

void require_closed_truth(const MeshCheck& check) {
  if (!check.closed() || !check.oriented()) {
    throw StageError(errors::kMeshNotClosed, "truth",
                     "the mesh is not closed and evenly oriented: " + describe_faults(check),
                     "close it first: rooms, volumes and thin walls need an inside");
  }
}

/// Openings are cut into walls that the labels keep closed.
std::function<bool(const Vec3&)> opening_test(const LabelledCells* cells) {
  if (cells == nullptr) {
    return [](const Vec3&) { return false; };
  }
  return [cells, locator = FaceLocator(cells->complex)](const Vec3& p) {
    const std::int64_t cell = locator.cell_at(p);
    return cell >= 0 && !is_empty(cells->label, cell);
  };
}

RoomScore room_score(const TruthRoom& room, const VolumeScores& volume, std::size_t index, double share) {
  RoomScore out{room,
                volume.room_m3[index],
                volume.room_empty_m3[index],
                volume.room_unknown_m3[index],
                RoomAnswer::kDenied,
                {}};
  if (out.empty_m3 > share * out.volume_m3) {
    out.answer = RoomAnswer::kFound;
  } else if (out.empty_m3 + out.unknown_m3 > share * out.volume_m3) {
    out.answer = RoomAnswer::kUnknown;
  }
  return out;
}

void score_spaces(const TriangleMesh& model, const TriangleMesh& truth, const TruthDescription& described,
                  const EvaluateParams& params, const SurfaceDistances& truth_samples,
                  const MeasuredSurface& truth_surface, const LabelledCells* cells,
                  const ScannedSurface* scanned, Scores& scores) {
  const Columns truth_columns(truth);
  const Columns model_columns(model);
  const std::vector<TruthRoom> rooms = locate_rooms(described.rooms, truth_columns);
  const RoomFinder finder(rooms, truth_columns);
  const Bounds3 a = bounds(model);
  const Bounds3 b = bounds(truth);
  const Vec2 lo = a.lo.cwiseMin(b.lo).head<2>();
  const Vec2 hi = a.hi.cwiseMax(b.hi).head<2>();
  scores.column_spacing_m = column_spacing(params.column_spacing_m, (hi - lo).x() * (hi - lo).y());
  std::optional<LabelledSpace> unknown;
  if (cells != nullptr) {
    unknown.emplace(cells->complex, cells->label, Label::kUnknown);
  }
  scores.volume = compare_volumes(
      {truth_columns, model_columns, rooms, finder, described.ignored, unknown ? &*unknown : nullptr}, lo, hi,
      scores.column_spacing_m, kColumnSeed);
  std::vector<std::uint8_t> found;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    scores.rooms.push_back(room_score(rooms[i], *scores.volume, i, params.found_share));
    scores.rooms.back().heights = score_heights(rooms[i], truth_columns, model_columns);
    found.push_back(scores.rooms.back().found() ? 1 : 0);
  }
  scores.columns = score_columns(described.columns, rooms, truth_columns, model_columns);
  scores.thin = score_thin_walls(truth_samples, truth_surface.all(), finder, model_columns,
                                 params.thin_wall_m, opening_test(cells), scanned);
  scores.merged = merged_rooms(scores.thin, found);
  if (cells != nullptr) {
    scores.explanation =
        explain({cells->complex, cells->label, cells->surfaces, cells->terms ? &*cells->terms : nullptr,
                 truth_columns, model_columns, truth_surface, rooms, finder, found, scores.thin,
                 described.ignored, params.thin_wall_m, b},
                scores.column_spacing_m, kColumnSeed);
  }
}

}  // namespace

std::size_t Scores::found() const {
  return static_cast<std::size_t>(
      std::count_if(rooms.begin(), rooms.end(), [](const RoomScore& room) { return room.found(); }));
}

UnenteredScores Scores::unentered() const {
  UnenteredScores out;
  for (const RoomScore& room : rooms) {
    if (!room.room.scanned) {
      ++out.rooms[static_cast<std::size_t>(room.answer)];
      out.volume_m3 += room.volume_m3;
      out.empty_m3 += room.empty_m3;
      out.unknown_m3 += room.unknown_m3;
    }
  }
  return out;
}

std::size_t Scores::in_merged_groups() const {
  std::size_t count = 0;
  for (const auto& group : merged) {
    count += group.size();
  }
  return count;
}

TriangleMesh prepared(const TriangleMesh& mesh, const ComparedAxes& axes) {
  TriangleMesh out = weld_vertices(mesh);
  for (Vec3& p : out.vertices) {
    p = axes.from_file(p);
  }
  if (volume(out) < 0) {
    flip_orientation(out);
  }
  return out;
}

Scores evaluate(const TriangleMesh& model, const TriangleMesh& truth, const TruthDescription& described,
                const EvaluateParams& params, const LabelledCells* cells, const ScannedSurface* scanned) {
  Scores scores;
  scores.truth_check = check_mesh(truth);
  require_closed_truth(scores.truth_check);
  scores.model_check = check_mesh(model);
  scores.diagonal_m = bounds(truth).diagonal();
  scores.sample_spacing_m = sample_spacing(params.sample_spacing_m, model, truth, scores.truth_check.area_m2);
  const MeasuredSurface model_surface(model);
  const MeasuredSurface truth_surface(truth);
  const auto counts = [&described](const Vec3& p) { return !described.ignored.contains(p); };
  const auto from_model =
      measure(model, model_surface, truth_surface, scores.sample_spacing_m, kModelSeed, counts);
  const auto from_truth = measure(truth, truth_surface, model_surface, scores.sample_spacing_m, kTruthSeed);
  scores.model_samples = from_model.samples.size();
  scores.truth_samples = from_truth.samples.size();
  scores.model_to_truth = from_model.deviation;
  scores.truth_to_model = from_truth.deviation;
  for (const double buffer : kBuffers) {
    scores.isprs.push_back({buffer, isprs_score(from_truth, from_model, SlopeClass::kWall, buffer),
                            isprs_score(from_truth, from_model, SlopeClass::kHorizontal, buffer)});
  }
  scores.walls_matched = matched_share(from_truth, SlopeClass::kWall);
  scores.walls_loosely_matched = matched_share(from_truth, SlopeClass::kWall, Match::kLoose);
  scores.horizontals_matched = matched_share(from_truth, SlopeClass::kHorizontal);
  scores.horizontals_finely_matched = matched_share(from_truth, SlopeClass::kHorizontal, Match::kFine);
  scores.slopes = score_slopes(from_truth, truth_surface, model_surface);
  scores.niches = score_niches(described.niches, from_truth, truth_surface, model_surface);
  if (scores.model_check.closed() && scores.model_check.oriented()) {
    score_spaces(model, truth, described, params, from_truth, truth_surface, cells, scanned, scores);
  }
  return scores;
}

}  // namespace roomcut::evaluate
