// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/artefact/provenance.h"
#include "common/geometry/sloped_plane.h"
#include "common/slices/slices.h"
#include "common/wall_lines/wall_line.h"

namespace roomcut {

/// A sloped plane that goes on to the partition. Local coordinates.
struct PlaneFeature {
  std::string id;  ///< "p0001"; unique; kept through edits
  SlopedPlane plane;
  LineSource source = LineSource::kDetected;  ///< detected, edited or added
  bool locked = false;                        ///< fit_surfaces leaves it as it is
  std::string note;                           ///< free text of the user
  std::string extra_json = "{}";  ///< unknown properties of the feature, kept as they came (canonical JSON)
};

/// The content of one planes.geojson.
struct AcceptedPlanes {
  Frame frame;
  Vec2 bbox_min{0, 0}, bbox_max{0, 0};  ///< of the scan, local metres; guards against degrees and millimetres
  std::string base_sha256;              ///< payload of the detection an edit started from; empty = none
  std::vector<Level> levels;            ///< ascending, at least 2; only z, cap and step count
  std::vector<PlaneFeature> planes;     ///< sorted by id
};

/// What people read and write of a plane besides its outline, as a file holds it (to 1e-6).
struct PlaneNumbers {
  double pitch_deg = 0;   ///< against the horizontal
  double uphill_deg = 0;  ///< direction of the rise in the scan's plan, counter-clockwise from x, 0 … 360
  double height_m = 0;    ///< in the scan's own coordinates, at the outline's middle
};

/// Centre of area of a ring that turns left.
Vec2 middle_of(const std::vector<Vec2>& ring);

PlaneNumbers numbers_of(const SlopedPlane& plane, const Frame& frame);

/// The plane over `outline` (convex, counter-clockwise, local) with these numbers; nothing measured.
SlopedPlane plane_of(std::vector<Vec2> outline, const PlaneNumbers& numbers, const Frame& frame);

/// The planes as a file holds them: everything rounded there, outlines as convex_hull() gives them, sorted by
/// id; without planes whose outline is less than the file's resolution. Coordinates stay local.
AcceptedPlanes normalised_planes(AcceptedPlanes planes);

}  // namespace roomcut
