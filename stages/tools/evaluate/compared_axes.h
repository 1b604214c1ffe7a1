// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/line2.h"

namespace roomcut::evaluate {

/// The axes in which model, truth and cells are compared: moved near the origin, so that sums and products
/// stay small, and turned as the cells of a levelled scan are.
struct ComparedAxes {
  Vec3 origin{0, 0, 0};  ///< in the coordinates of the files
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 from_file(const Vec3& p) const { return turn * (p - origin); }
  Vec3 to_file(const Vec3& p) const { return turn.transpose() * p + origin; }
};

}  // namespace roomcut::evaluate
