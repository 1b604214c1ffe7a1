// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/artefact/json.h"
#include "common/sloped_planes/accepted_planes.h"
#include "common/wall_lines/edit_document.h"

// The parts of read_edited_planes(). Each adds what is wrong to the report and goes on.
namespace roomcut {

inline constexpr EditKind kPlanesEdit{artefacts::kPlanes, "planes",   "make edit-planes",
                                      "make drop-planes", "plane_id", LineCoordinates::kScan};

/// A plane as drawn, in the coordinates of the file. What the file leaves out is empty.
struct DrawnPlane {
  std::size_t feature = 0;
  std::string id;
  std::vector<Vec2> outline;  ///< convex_hull() of the ring
  std::optional<double> pitch_deg, uphill_deg, height_m;
  std::optional<bool> ceiling;
  bool locked = false;
  std::string note;
  std::string extra_json = "{}";
};

/// The features as planes. Reports kLinesGeometry, kLinesCoordinates, kLinesProperty.
std::vector<DrawnPlane> read_plane_features(const Json& features, EditReport& report);

/// Gives ids, decides what is detected, edited or added, and takes from the base what the file leaves out.
/// Of `drawn` outlines are local, numbers in the scan's own coordinates. Reports kLinesProperty for numbers
/// that neither has and kLinesOutside for heights far from the building's; then the result is empty.
std::vector<PlaneFeature> identify_planes(std::vector<DrawnPlane> drawn, const AcceptedPlanes& base,
                                          EditReport& report);

/// The place of a plane in messages.
inline std::string place_of(const DrawnPlane& drawn) {
  return feature_place(drawn.feature, drawn.id, kPlanesEdit.id);
}

}  // namespace roomcut
