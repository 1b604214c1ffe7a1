// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stages/tools/synthesize/scene_reader.h"

namespace roomcut::synthesize {

/// The circular parts of a polygon whose sides came from the listed sides `side` (SceneNode::polygon): those
/// of four chords or more.
std::vector<SceneArc> arcs_of(const Polygon2& polygon, const std::vector<std::size_t>& side);

/// Reads what a room has beside its plan and its level heights: `slopes`, `roof`, `columns`, `niches`. The
/// room has its polygon, floor and ceiling. Problems are the node's.
void read_room_elements(SceneNode& node, SceneRoom& room);

}  // namespace roomcut::synthesize
