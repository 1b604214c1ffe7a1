// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "stages/tools/compare/run_facts.h"

namespace roomcut::compare {

/// A line of that id.
WallLine wall(const std::string& id, const Vec2& a, const Vec2& b);

/// A run with one room: from (0, 0) to (`width`, 4), 3 m high, its four lines w0001 … w0004 (south, east,
/// north, west), and a cell of solid around it up to the box (-1, -1) (9, 5).
RunFacts square_run(const std::string& name, double width);

}  // namespace roomcut::compare
