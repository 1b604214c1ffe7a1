// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/mesh/mesh_check.h"
#include "stages/tools/evaluate/arc_scores.h"
#include "stages/tools/evaluate/compared_axes.h"
#include "stages/tools/evaluate/element_scores.h"
#include "stages/tools/evaluate/explain.h"
#include "stages/tools/evaluate/params.h"
#include "stages/tools/evaluate/scanned_surface.h"
#include "stages/tools/evaluate/surface_scores.h"
#include "stages/tools/evaluate/thin_walls.h"
#include "stages/tools/evaluate/truth_rooms.h"
#include "stages/tools/evaluate/volume_scores.h"

namespace roomcut::evaluate {

inline constexpr std::array<double, 4> kBuffers = {0.01, 0.02, 0.05, 0.10};  ///< of the ISPRS scores [m]

/// What the model says of a room of the truth.
enum class RoomAnswer : std::uint8_t {
  kFound,    ///< most of it is empty
  kUnknown,  ///< no, but most of it is empty or labelled unknown
  kDenied,
};
inline constexpr std::array<const char*, 3> kRoomAnswers = {"found", "unknown", "denied"};

struct RoomScore {
  TruthRoom room;
  double volume_m3 = 0;
  double empty_m3 = 0, unknown_m3 = 0;  ///< parts of it, in the model
  RoomAnswer answer = RoomAnswer::kDenied;
  RoomHeights heights = {};
  bool found() const { return answer == RoomAnswer::kFound; }
};

/// Rooms of the truth in which no scanner stood: a model cannot know them, but may have the space.
struct UnenteredScores {
  std::array<std::size_t, 3> rooms = {};  ///< by RoomAnswer
  double volume_m3 = 0, empty_m3 = 0, unknown_m3 = 0;
  double denied_m3() const { return std::max(0.0, volume_m3 - empty_m3 - unknown_m3); }
};

/// How good a model is. What needs volumes is empty for a model that is not closed.
struct Scores {
  MeshCheck model_check, truth_check;
  double diagonal_m = 0;                              ///< of the truth's bounding box
  double sample_spacing_m = 0, column_spacing_m = 0;  ///< as used
  std::size_t model_samples = 0, truth_samples = 0;
  Deviation model_to_truth, truth_to_model;
  struct Isprs {
    double buffer_m;
    IsprsScore walls, horizontals;
  };
  std::vector<Isprs> isprs;
  /// Share of the truth's wall and horizontal area that a model surface follows closely; and of walls at
  /// least loosely.
  std::optional<double> walls_matched, horizontals_matched, walls_loosely_matched;
  std::optional<double> horizontals_finely_matched;  ///< within 1 degree and 5 mm
  SlopeScores slopes;
  NicheScores niches;
  std::optional<ColumnScores> columns;
  std::optional<ArcScores> arcs;  ///< of a model whose summary says which walls are curved
  std::optional<VolumeScores> volume;
  std::vector<RoomScore> rooms;
  std::vector<std::vector<std::int32_t>> merged;  ///< groups of rooms
  ThinWallScores thin;
  std::optional<Explanation> explanation;

  std::size_t found() const;
  UnenteredScores unentered() const;
  std::size_t in_merged_groups() const;
};

/// Prepares a mesh as it came from a file: equal vertices welded, brought into `axes`, normals out of the
/// enclosed space.
TriangleMesh prepared(const TriangleMesh& mesh, const ComparedAxes& axes);

/// What a truth.json says beside the truth's mesh, in the axes of the comparison.
struct TruthDescription {
  std::vector<DescribedRoom> rooms;
  IgnoredSpace ignored;
  std::vector<DescribedColumn> columns = {};
  std::vector<DescribedNiche> niches = {};
  std::vector<DescribedArc> arcs = {};
};

/// Scores `model` against `truth`, both prepared() with the same axes; `described` in them, too; `cells`, if
/// given, are those that the model was made of, and are explained; `scanned`, if given, is the scan that it
/// was made of: walls of which it shows nothing merge no rooms. Throws StageError(kMeshNotClosed) when the
/// truth is not a closed, oriented mesh, kTooComplex when a chosen spacing asks for more than 20 million
/// samples; with `auto` the spacing grows until 1 million do. Parallel; the same result for any number of
/// threads.
Scores evaluate(const TriangleMesh& model, const TriangleMesh& truth, const TruthDescription& described,
                const EvaluateParams& params, const LabelledCells* cells = nullptr,
                const ScannedSurface* scanned = nullptr);

}  // namespace roomcut::evaluate
