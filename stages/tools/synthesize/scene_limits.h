// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/errors/error.h"
#include "stages/tools/synthesize/scene.h"

namespace roomcut::synthesize {

/// What a scene may ask for: time and memory grow with these, a building of any size stays below.
namespace scene_limits {
inline constexpr std::size_t kCorners = 2000;       ///< of one polygon, arcs as chords
inline constexpr std::size_t kAllCorners = 100000;  ///< of all rooms and shafts
inline constexpr std::size_t kItems =
    10000;  ///< rooms; doors; windows; furniture; shafts; stations; columns; niches
inline constexpr std::size_t kSlopes = 32;    ///< of one room: each is cut with each
inline constexpr double kCopies = 100000;     ///< rooms, doors and windows of all copies together
inline constexpr double kRoom_m2 = 20000;     ///< the box around one room's plan
inline constexpr double kAllRooms_m2 = 1e6;   ///< of all rooms, without copies
inline constexpr double kRoomClutter = 2000;  ///< random furniture of one room
inline constexpr double kAllClutter = 50000;
inline constexpr double kPatches = 50000;     ///< round holes
inline constexpr double kLayers = 2e7;        ///< different heights times rooms and openings
inline constexpr double kLeastShare = 0.001;  ///< of a tripod's beams that return
inline constexpr std::size_t kText = 200;     ///< characters of a name
inline constexpr std::size_t kProblems = 50;  ///< that are listed
}  // namespace scene_limits

/// Throws StageError(kSceneInvalid) with all that `scene` asks too much of.
void check_limits(const Scene& scene);

/// `text`, or its beginning when it is too long for a message.
std::string shown(const std::string& text);

/// Throws StageError with the first of `problems` (scene_limits::kProblems) and how many there are more.
[[noreturn]] void refuse_scene(std::vector<Problem> problems);

}  // namespace roomcut::synthesize
