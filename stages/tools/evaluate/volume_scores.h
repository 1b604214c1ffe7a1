// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/tools/evaluate/spaces.h"
#include "stages/tools/evaluate/truth_rooms.h"

namespace roomcut::evaluate {

struct ComparedVolumes {
  double truth_m3 = 0, model_m3 = 0, common_m3 = 0;
  double iou() const { return common_m3 / (truth_m3 + model_m3 - common_m3); }
  double recall() const { return truth_m3 > 0 ? common_m3 / truth_m3 : 0; }
  double precision() const { return model_m3 > 0 ? common_m3 / model_m3 : 0; }
};

/// Volumes along a jittered grid of vertical lines: exact in height, stratified sampling in plan.
struct VolumeScores : ComparedVolumes {
  ComparedVolumes seen;            ///< without the space of rooms that nobody entered
  double ignored_m3 = 0;           ///< of the model, counted nowhere
  double unknown_m3 = 0;           ///< labelled unknown
  double unknown_in_truth_m3 = 0;  ///< the part of it that is empty in the truth
  /// Per truth room: its volume, and the parts of it that are empty in the model and labelled unknown.
  std::vector<double> room_m3, room_empty_m3, room_unknown_m3;
};

/// What compare_volumes() compares: both meshes closed, normals out of the empty space.
struct VolumeInput {
  const Columns& truth;
  const Columns& model;
  const std::vector<TruthRoom>& rooms;
  const RoomFinder& finder;
  const IgnoredSpace& ignored;
  const LabelledSpace* unknown;  ///< null: nothing is unknown
};

/// One line per square of `spacing_m`, at a random place
/// in it (counter-based). Parallel by rows, summed in order: the same result for any number of threads.
VolumeScores compare_volumes(const VolumeInput& input, const Vec2& lo, const Vec2& hi, double spacing_m,
                             std::uint64_t seed);

}  // namespace roomcut::evaluate
