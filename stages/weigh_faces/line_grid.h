// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bitset>
#include <cstdint>
#include <span>
#include <vector>

#include "common/cells/plan_grid.h"
#include "common/cloud/cloud.h"

namespace roomcut::weigh_faces {

/// A wall line with its normal worked out.
struct PlanLine {
  Vec2 normal, direction;
  double d, theta;
  std::vector<std::uint8_t> carries;  // per layer: whether the line may carry a wall there
  std::bitset<kAzimuthSteps> faces;   // per azimuth of a point: whether its wall may lie on the line
  double distance(const Vec2& p) const { return normal.dot(p) - d; }
  double along(const Vec2& p) const { return direction.dot(p); }
};

/// For any point of the plan the lines that have an edge within `reach` of it (and perhaps a few more): a
/// grid whose bins list the lines that pass, made from the complex's edges, so that lines count only as far
/// as they go.
class LineGrid {
 public:
  /// A wall point may lie on a line whose normal differs from its own by at most `azimuth` [rad].
  LineGrid(const CellComplex& complex, double reach, double azimuth);

  const PlanLine& line(std::int32_t index) const { return plan_lines_[static_cast<std::size_t>(index)]; }

  /// Indices of lines, ascending; empty outside the plan.
  std::span<const std::int32_t> near(const Vec2& p) const {
    const int ix = grid_.column(p.x());
    const int iy = grid_.row(p.y());
    if (!grid_.contains(ix, iy)) {
      return {};
    }
    const std::size_t bin = grid_.index(ix, iy);
    return {lines_.data() + first_[bin], lines_.data() + first_[bin + 1]};
  }

 private:
  PlanGrid grid_;
  std::vector<std::uint32_t> first_;
  std::vector<std::int32_t> lines_;
  std::vector<PlanLine> plan_lines_;
};

}  // namespace roomcut::weigh_faces
