// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace roomcut {

/// The scan's frame as a coordinate system, in well-known text: metres, and nothing that could be
/// reprojected. Without it GDAL, hence QGIS, takes the numbers for degrees.
inline constexpr const char* kLocalCrs = "LOCAL_CS[\"scan frame (metres)\",UNIT[\"metre\",1]]";

}  // namespace roomcut
