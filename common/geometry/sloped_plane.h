// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "common/geometry/line2.h"

namespace roomcut {

/// A floor or ceiling that slopes: the height gradient · p + c over its footprint.
struct SlopedPlane {
  Vec2 gradient{0, 0};        ///< rise per metre, uphill; its norm is tan(pitch)
  double c = 0;               ///< height over the local origin [m]
  std::vector<Vec2> outline;  ///< convex hull of where its points lie, counter-clockwise [m]
  double area_m2 = 0;         ///< surface of its points
  double rms_m = 0;           ///< their distance from it, along its normal [m]
  bool ceiling = true;        ///< seen from below, as roofs and stair undersides are; false: a ramp

  double height(const Vec2& p) const { return gradient.dot(p) + c; }

  /// Whether p lies in the outline, or within `margin_m` of its sides' lines.
  bool covers(const Vec2& p, double margin_m) const {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2& a = outline[i];
      const Vec2 along = outline[i + 1 < outline.size() ? i + 1 : 0] - a;
      const Vec2 to = p - a;
      if (along.x() * to.y() - along.y() * to.x() < -margin_m * along.norm()) {
        return false;
      }
    }
    return !outline.empty();
  }

  /// Lowest and highest height over the outline [m].
  std::pair<double, double> range() const {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vec2& p : outline) {
      low = std::min(low, height(p));
      high = std::max(high, height(p));
    }
    return {low, high};
  }
};

}  // namespace roomcut
