// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "common/cells/face_locator.h"
#include "stages/tools/evaluate/columns.h"
#include "stages/tools/evaluate/compared_axes.h"

namespace roomcut::evaluate {

/// Space of which the truth says nothing: boxes around rooms that it had to leave out, along the axes of the
/// files. What a model makes of it counts nowhere; a room of the truth that lies in it counts as everywhere.
class IgnoredSpace {
 public:
  IgnoredSpace() = default;
  IgnoredSpace(std::vector<Bounds3> boxes, const ComparedAxes& axes)
      : boxes_(std::move(boxes)), axes_(axes) {}
  bool contains(const Vec3& p) const;
  /// The parts of the vertical line at (x, y) that lie in it and not in `truth_parts` (sorted, disjoint).
  void at(double x, double y, const std::vector<Interval>& truth_parts, std::vector<Interval>& out) const;

 private:
  std::vector<Bounds3> boxes_;
  ComparedAxes axes_;
};

/// The cells of one label.
class LabelledSpace {
 public:
  /// Both must outlive it.
  LabelledSpace(const CellComplex& complex, const std::vector<std::uint8_t>& label, std::uint8_t wanted)
      : complex_(complex), label_(label), wanted_(wanted), locator_(complex) {}
  /// The parts of the vertical line at (x, y) that lie in it, sorted and disjoint.
  void at(double x, double y, std::vector<Interval>& out) const;

 private:
  const CellComplex& complex_;
  const std::vector<std::uint8_t>& label_;
  std::uint8_t wanted_;
  FaceLocator locator_;
};

}  // namespace roomcut::evaluate
