// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/tools/evaluate/explain.h"

namespace roomcut::evaluate {

/// A part of a vertical line that is solid in the truth, in a cell that is solid there and labelled empty.
struct InventedPart {
  std::size_t cell;
  Vec3 middle;
  double length;  ///< [m]
};

/// The invented spaces: cells of `parts` that share a face are one group; it is a space when the middle of
/// one of its parts is farther from the truth's surface than half of the thickest wall. Each part stands for
/// `area_m2` of the plan. Parallel; the same result for any number of threads.
std::vector<Explanation::InventedSpace> find_invented(const ExplainInput& input,
                                                      const std::vector<InventedPart>& parts, double area_m2);

}  // namespace roomcut::evaluate
