// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace roomcut {

/// What an artefact was made from. `path` is relative to the artefact's own folder; no date, host or absolute
/// path.
struct InputRecord {
  std::string name;            ///< the stage's name of the input, e.g. "cloud"
  std::string artefact;        ///< artefact type, or "scan" for a point cloud file
  std::string schema_version;  ///< "1.0"; empty for files that have none
  std::string payload_sha256;  ///< hex
  std::string path;
};

/// Stored as /provenance (HDF5) or `provenance` (JSON) in every artefact.
struct Provenance {
  std::string stage;
  int stage_revision = 0;
  std::string params_json;  ///< canonical: sorted keys, no spaces
  std::string params_sha256;
  std::vector<InputRecord> inputs;
};

/// Metres and z up inside; `origin` was subtracted from every coordinate on reading and is added back on
/// export.
struct Frame {
  double origin[3] = {0, 0, 0};  ///< [m], in the scan's coordinates after `up` and `unit` were applied
  std::string unit = "m";        ///< the scan's length unit as read: m, mm, cm, ft
  std::string up = "z";          ///< the scan's up axis as read: x, y, z, -x, -y, -z
  /// The unit vector, in the scan's axes after `up`, that is z here: other than 0 0 1 where a leaning scan
  /// was levelled. It was turned about the origin (common/geometry/level_turn.h); exports turn it back.
  double level[3] = {0, 0, 1};
  /// The scan's coordinate system as its file states it: well-known text, or "EPSG:25832"; "" when it says
  /// none.
  std::string crs;
  bool levelled() const { return level[0] != 0 || level[1] != 0; }
};

}  // namespace roomcut
