// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/params/params.h"

namespace roomcut::report {

struct ReportParams {
  int picture_px = 1100;      ///< width of model views
  int cloud_points = 200000;  ///< points of the scan in picture and page
};

/// The block `report` of pipeline.yaml, bound to `p`.
inline ParameterTable parameters(ReportParams& p) {
  return {
      integer("picture_px", p.picture_px, "px", 200, 8000, "Width of the pictures of the model."),
      integer("cloud_points", p.cloud_points, "1", 0, 100000000,
              "Points drawn in the picture of the cloud, at most."),
  };
}

}  // namespace roomcut::report
