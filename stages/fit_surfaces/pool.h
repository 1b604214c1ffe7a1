// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace roomcut::fit_surfaces {

/// Height of one region and its standard deviation [m].
struct PooledHeight {
  double z = 0, sigma = 0;
};

/// Rooms of one level mostly have one height, or heights of their own: which, the regions' scatter beyond
/// their sigmas tells (empirical Bayes). Each height is drawn to their common mean by as much as its own
/// sigma is larger than that scatter: where rooms truly differ, by nothing; where only a warped scan lets
/// them seem to, all the way. What lies 3 standard deviations off is another height and stays where it is. A
/// sigma is never stated smaller than half of the region's own.
void pool_heights(std::vector<PooledHeight>& heights);

}  // namespace roomcut::fit_surfaces
