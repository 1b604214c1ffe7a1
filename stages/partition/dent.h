// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "common/geometry/line2.h"

namespace roomcut::partition {

/// How far a polygon is from being convex: the largest distance of a corner from the side of the convex hull
/// that passes over it [m]; 0 for a convex polygon. `corners` counter-clockwise, at least 3, of a polygon
/// that is convex but for corners that are nearly straight. Unlike the turn at a corner, it does not depend
/// on how short the sides there are. Linear.
double dent(std::vector<Vec2> corners);

}  // namespace roomcut::partition
