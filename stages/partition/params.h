// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace roomcut::partition {

/// Parameters of partition (names, units, ranges and meanings: partition_parameters() in main.cpp).
struct PartitionParams {
  double margin_m = 0.5;
  double extend_m = 2.0;
  bool prune = true;
  int max_cells = 20000000;
};

}  // namespace roomcut::partition
