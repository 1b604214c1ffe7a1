// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params/params.h"

namespace roomcut::partition {

struct PartitionParams {
  double margin_m = 0.5;
  double extend_m = 2.0;
  bool prune = true;
  int max_cells = 20000000;
};

/// The block `partition` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(PartitionParams& p) {
  return {
      number("margin_m", p.margin_m, "m", 0.05, 100.0,
             "Distance of the bounding box from the scan and the lines."),
      number("extend_m", p.extend_m, "m", 0.0, 10000.0,
             "A line cuts the faces that its support, lengthened by this at both ends, enters."),
      boolean(
          "prune", p.prune,
          "Takes away the parts of a line beyond its reach that no other line needs: fewer, larger cells."),
      integer("max_cells", p.max_cells, "1", 1000, 200000000,
              "More cells than this are an error, not a long wait."),
  };
}

}  // namespace roomcut::partition
