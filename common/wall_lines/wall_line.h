// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/artefact/provenance.h"
#include "common/geometry/line2.h"

namespace roomcut {

enum class LineSource { kDetected, kEdited, kAdded, kRefined };

/// One wall line: a vertical plane seen from above, with the interval where points support it.
/// Two faces of one wall are two wall lines. Coordinates are local metres (Frame::origin subtracted).
struct WallLine {
  std::string id;  ///< "w0001"; unique; kept through edits and refinement
  Vec2 a, b;       ///< ends of the support interval; their order means nothing [m]
  LineSource source = LineSource::kDetected;
  bool locked = false;                     ///< held constant by refine_lines
  std::optional<std::vector<int>> levels;  ///< indices of wall slices where the line may cut; nullopt = all
  double support_m = 0;                    ///< length of line that is covered by points [m]
  double rms_m = 0;                        ///< of the points' distances [m]
  double sigma_offset_m = 0;   ///< standard deviation of the offset at the support's centre [m]; 0 = unknown
  double sigma_angle_rad = 0;  ///< standard deviation of theta [rad]; 0 = unknown
  std::string note;            ///< free text of the user
  std::string extra_json = "{}";  ///< unknown properties of the feature, kept as they came (canonical JSON)

  Line2 line() const { return line_through(a, b); }
  Vec2 centre() const { return 0.5 * (a + b); }
  double length() const { return (b - a).norm(); }
};

/// The content of one wall_lines.geojson.
struct WallLines {
  Frame frame;
  Vec2 bbox_min{0, 0}, bbox_max{0, 0};  ///< of the scan, local metres; guards against degrees and millimetres
  std::string base_sha256;              ///< payload of the detection an edit started from; empty = none
  std::vector<WallLine> lines;          ///< sorted by id
};

}  // namespace roomcut
