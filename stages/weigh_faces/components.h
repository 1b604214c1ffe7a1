// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace roomcut {

/// Connected regions of a grid.
struct Components {
  std::int32_t count = 0;
  std::vector<std::int32_t> grown;  ///< per bin: its region; empty bins beside a region (4-neighbours) get
                                    ///< the lowest one's number; -1 none
};

/// 4-connected components of the bins that are not 0, numbered in the order of their first bin.
Components find_components(const std::vector<std::uint8_t>& occupied, int nx, int ny);

}  // namespace roomcut
