// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "common/artefact/provenance.h"

namespace roomcut {

/// The coordinate system of what is written in the scan's own coordinates
/// (common/geometry/scan_coordinates.h), as GDAL, hence QGIS, reads it: the scan's, where it names one and
/// its numbers are written as they were, that is in metres and z up; else one in well-known text that has
/// metres and nothing that could be reprojected. Without any the numbers would be taken for degrees.
inline std::string crs_of(const Frame& frame) {
  const bool as_read = frame.unit == "m" && frame.up == "z";
  return as_read && !frame.crs.empty() ? frame.crs : "LOCAL_CS[\"scan frame (metres)\",UNIT[\"metre\",1]]";
}

}  // namespace roomcut
