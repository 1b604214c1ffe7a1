// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "common/artefact/json.h"
#include "common/wall_lines/wall_line.h"

namespace roomcut {

/// The member of the file that holds all that is not GeoJSON.
inline constexpr const char* kMember = "roomcut";

/// Names of the properties that the format defines; all others are the user's.
inline constexpr const char* kKnownProperties[] = {"wall_id", "source",         "locked",
                                                   "levels",  "support_m",      "rms_m",
                                                   "note",    "sigma_offset_m", "sigma_angle_deg"};

std::string_view source_name(LineSource source);
/// Throws std::invalid_argument for another word.
LineSource source_from_name(std::string_view name);

/// A coordinate as the file holds it: rounded to 1e-6 m, never -0.
double rounded_coordinate(double value);
Vec2 rounded_point(const Vec2& point);

/// The lines as the file holds them: rounded, the lexicographically smaller end first, sorted by id.
WallLines normalised_lines(WallLines lines);

/// The whole text of the file; `payload_sha256` as wall_lines_payload_sha256() gives it.
std::string wall_lines_text(const WallLines& normalised, const Provenance& provenance,
                            const std::string& payload_sha256);

}  // namespace roomcut
