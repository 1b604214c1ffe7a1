// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/artefact/json.h"
#include "common/errors/error.h"
#include "common/wall_lines/wall_line.h"

// The parts of read_edited_wall_lines(). Each adds what is wrong to `EditReport::problems` and goes on, so
// that a person sees all problems of the file at once.
namespace roomcut {

/// Problems and warnings found in a hand-edited file.
struct EditReport {
  std::string path;
  std::vector<Problem> problems;
  std::vector<std::string> warnings;

  void problem(ErrorCode code, const std::string& place, const std::string& what, const std::string& hint) {
    problems.push_back({code, place.empty() ? path : path + ": " + place, what, hint});
  }
  void warn(const std::string& place, const std::string& what) {
    warnings.push_back((place.empty() ? path : path + ": " + place) + ": " + what);
  }
};

/// The file's text as JSON. Throws StageError at once when nothing can be made of it: kLinesUnreadable,
/// kLinesNotJson, kLinesNotFeatureCollection. Repeated keys are reported (kLinesDuplicateKey).
Json read_edit_document(const std::filesystem::path& path, EditReport& report);

/// What the member `roomcut` says, compared with the base.
struct EditOrigin {
  std::string base_sha256;  ///< detection that the edit began from; "" when the file doesn't say
  Vec2 shift{0, 0};         ///< to be added to the coordinates: the frame's origin moved since [m]
};

/// Reports kLinesNoMember, kLinesVersion, kLinesUnit; warns when the member is missing or the origin moved.
EditOrigin read_edit_member(const Json& document, const Frame& base_frame, EditReport& report);

/// A line as drawn, with the feature that it came from.
struct DrawnLine {
  std::size_t feature = 0;
  int piece = 0;  ///< 1, 2 … for the pieces of a polyline, 0 for a plain line
  WallLine line;  ///< id empty when the feature has none; measured properties are not read
};

/// The features as lines. Reports kLinesGeometry, kLinesCoordinates, kLinesProperty.
std::vector<DrawnLine> read_edit_features(const Json& features, const Vec2& shift, EditReport& report);

/// "features[17]" or "features[17] (wall_id w0017)".
std::string feature_place(std::size_t index, const std::string& id);

/// Below it a line has no direction worth the name [m].
inline constexpr double kShortestLine_m = 1e-3;

/// Reports kLinesOutside for lines far outside the base's box, naming the likely cause, and kLinesDegenerate.
void check_edit_extent(const std::vector<DrawnLine>& drawn, const WallLines& base, EditReport& report);

/// Gives ids, decides what is detected, edited or added, and takes from the base what editors drop. Result
/// sorted by id.
std::vector<WallLine> identify_lines(std::vector<DrawnLine> drawn, const WallLines& base, EditReport& report);

}  // namespace roomcut
