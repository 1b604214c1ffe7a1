// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/mesh/mesh_check.h"
#include "stages/tools/evaluate/explain.h"
#include "stages/tools/evaluate/params.h"
#include "stages/tools/evaluate/surface_scores.h"
#include "stages/tools/evaluate/thin_walls.h"
#include "stages/tools/evaluate/truth_rooms.h"
#include "stages/tools/evaluate/volume_scores.h"

namespace roomcut::evaluate {

inline constexpr std::array<double, 4> kBuffers = {0.01, 0.02, 0.05, 0.10};  ///< of the ISPRS scores [m]

struct RoomScore {
  TruthRoom room;
  double volume_m3 = 0, empty_m3 = 0;
  bool found = false;
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
  /// Share of the truth's wall and horizontal area within 1 degree and 2 cm of a model surface.
  std::optional<double> walls_matched, horizontals_matched;
  std::optional<VolumeScores> volume;
  std::vector<RoomScore> rooms;
  std::vector<std::vector<std::int32_t>> merged;  ///< groups of rooms
  ThinWallScores thin;
  std::optional<Explanation> explanation;

  std::size_t found() const;
  std::size_t in_merged_groups() const;
};

/// The axes in which model, truth and cells are compared: moved near the origin, so that sums and products
/// stay small, and turned as the cells of a levelled scan are.
struct ComparedAxes {
  Vec3 origin{0, 0, 0};  ///< in the coordinates of the files
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 from_file(const Vec3& p) const { return turn * (p - origin); }
};

/// Prepares a mesh as it came from a file: equal vertices welded, brought into `axes`, normals out of the
/// enclosed space.
TriangleMesh prepared(const TriangleMesh& mesh, const ComparedAxes& axes);

/// Scores `model` against `truth`, both prepared() with the same axes; `rooms` in them, too; `cells`, if
/// given, are those that the model was made of, and are explained. Throws StageError(kMeshNotClosed) when the
/// truth is not a closed, oriented mesh, kTooComplex when a chosen spacing asks for more than 20 million
/// samples; with `auto` the spacing grows until 1 million do. Parallel; the same result for any number of
/// threads.
Scores evaluate(const TriangleMesh& model, const TriangleMesh& truth, const std::vector<DescribedRoom>& rooms,
                const EvaluateParams& params, const LabelledCells* cells = nullptr);

}  // namespace roomcut::evaluate
