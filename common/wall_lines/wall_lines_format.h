// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "common/artefact/json.h"
#include "common/geometry/scan_coordinates.h"
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

/// The coordinates in which a file holds its lines: the scan's own, or local ones (files of version 1.0,
/// which do not say so).
enum class LineCoordinates { kLocal, kScan };

/// The member that says so, and its two values.
inline constexpr const char* kCoordinatesKey = "coordinates";
inline constexpr const char* kScanCoordinates = "scan";
inline constexpr const char* kLocalCoordinates = "local";

/// Between local coordinates and those of a file.
class FilePlan {
 public:
  FilePlan(const Frame& frame, LineCoordinates coordinates)
      : scan_(frame), local_(coordinates == LineCoordinates::kLocal) {}
  /// As the file holds it: rounded to 1e-6 m.
  Vec2 to_file(const Vec2& local) const;
  Vec2 to_local(const Vec2& file) const {
    return local_ ? file : without_rounding(scan_.plan_to_local(file));
  }

 private:
  ScanCoordinates scan_;
  bool local_;
};

/// A coordinate as the file holds it: rounded to 1e-6 m, never -0.
double rounded_coordinate(double value);
Vec2 rounded_point(const Vec2& point);

/// The lines as a file holds them: rounded there, the end that is lexicographically smaller there first,
/// sorted by id. Their coordinates stay local.
WallLines normalised_lines(WallLines lines, LineCoordinates coordinates = LineCoordinates::kScan);

/// Digest of the lines as a file of that version holds them.
std::string lines_payload_sha256(const WallLines& lines, LineCoordinates coordinates,
                                 const std::string& version);

/// The whole text of the file, in the scan's own coordinates; `payload_sha256` as wall_lines_payload_sha256()
/// gives it.
std::string wall_lines_text(const WallLines& normalised, const Provenance& provenance,
                            const std::string& payload_sha256);

}  // namespace roomcut
