// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/wall_lines/wall_line.h"

namespace roomcut {

/// Two lines are the same when no end lies further than this from its partner: twice the resolution of the
/// file [m].
inline constexpr double kSameLine_m = 2e-6;

/// The larger distance between partner ends, for the better of the two directions: the order of ends means
/// nothing [m].
double end_distance(const WallLine& a, const WallLine& b);

inline bool same_geometry(const WallLine& a, const WallLine& b) {
  return end_distance(a, b) <= kSameLine_m;
}

/// How far a line was moved from its place in the base.
struct LineMove {
  std::string id;
  double offset_m = 0;   ///< distance of the new line from the old support's centre
  double angle_rad = 0;  ///< turn, 0 … pi/2
  double ends_m = 0;     ///< end_distance()
};

/// How far `to`, the same line elsewhere, lies from `from`; its id is that of `to`.
LineMove move_between(const WallLine& from, const WallLine& to);

struct LineDifferences {
  std::vector<std::string> same;
  std::vector<LineMove> moved;
  std::vector<std::string> added;    ///< ids of `lines` that the base has neither by id nor by geometry
  std::vector<std::string> deleted;  ///< ids of the base that are gone
};

/// The id of the base that `id` comes from: itself, or "w0007" for "w0007.2", a piece of a polyline; "" when
/// there is none.
std::string base_id(const std::string& id, const std::vector<WallLine>& base);

/// Compares `lines` with `base`: by id first, then by geometry. Both sorted by id; so are the lists of the
/// result.
LineDifferences compare_lines(const std::vector<WallLine>& base, const std::vector<WallLine>& lines);

}  // namespace roomcut
