// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/tools/evaluate/truth_rooms.h"

namespace roomcut::evaluate {

/// Volumes along a jittered grid of vertical lines: exact in height, stratified sampling in plan.
struct VolumeScores {
  double truth_m3 = 0, model_m3 = 0, common_m3 = 0;
  double iou() const { return common_m3 / (truth_m3 + model_m3 - common_m3); }
  double recall() const { return truth_m3 > 0 ? common_m3 / truth_m3 : 0; }
  double precision() const { return model_m3 > 0 ? common_m3 / model_m3 : 0; }
  std::vector<double> room_m3;        ///< per truth room
  std::vector<double> room_empty_m3;  ///< the part of it that is empty in the model
};

/// Both meshes closed, normals out of the empty space. One line per square of `spacing_m`, at a random place
/// in it (counter-based). Parallel by rows, summed in order: the same result for any number of threads.
VolumeScores compare_volumes(const Columns& truth, const Columns& model, const std::vector<TruthRoom>& rooms,
                             const RoomFinder& finder, const Vec2& lo, const Vec2& hi, double spacing_m,
                             std::uint64_t seed);

}  // namespace roomcut::evaluate
