// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/artefact/json.h"
#include "common/artefact/types.h"
#include "common/errors/error.h"
#include "common/wall_lines/wall_line.h"
#include "common/wall_lines/wall_lines_format.h"

// The parts of read_edited_wall_lines(), and what read_edited_planes() (common/sloped_planes) shares with it.
// Each adds what is wrong to `EditReport::problems` and goes on, so that a person sees all problems of the
// file at once.
namespace roomcut {

/// A kind of file that people edit, and its words.
struct EditKind {
  ArtefactType type;
  const char* things;        ///< "lines"
  const char* copy;          ///< the command that begins an edit
  const char* drop;          ///< … and that takes it back
  const char* id;            ///< the property that names a feature
  LineCoordinates unstated;  ///< of files whose member `roomcut` does not say
};
inline constexpr EditKind kLinesEdit{artefacts::kWallLines, "lines",   "make edit-lines",
                                     "make drop-edit",      "wall_id", LineCoordinates::kLocal};

/// Problems and warnings found in a hand-edited file.
struct EditReport {
  EditKind kind = kLinesEdit;
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
  std::optional<LineCoordinates> coordinates;  ///< of the lines; none: the file has no member that says so
  Frame frame;  ///< where the file's local coordinates lie: its own, else the base's
};

/// From the coordinates of an edit to local ones of the base.
class EditPlan {
 public:
  EditPlan(LineCoordinates coordinates, const Frame& own, const Frame& base);
  Vec2 to_base(const Vec2& drawn) const;
  /// A height of the file at a place of the file.
  double height_to_base(const Vec2& drawn, double height) const;
  /// A direction of the plan as the base has it, a unit vector.
  Vec2 direction_to_base(const Vec2& drawn) const;
  LineCoordinates coordinates() const { return coordinates_; }

 private:
  LineCoordinates coordinates_;
  ScanCoordinates own_, base_;
  bool as_it_is_;  ///< local coordinates of the base's frame
};

/// Reports kLinesNoMember, kLinesVersion, kLinesUnit; warns when the member is missing, or the origin of
/// local coordinates moved.
EditOrigin read_edit_member(const Json& document, const Frame& base_frame, EditReport& report);

/// A line as drawn, with the feature that it came from.
struct DrawnLine {
  std::size_t feature = 0;
  int piece = 0;  ///< 1, 2 … for the pieces of a polyline, 0 for a plain line
  WallLine line;  ///< id empty when the feature has none; measured properties are not read
};

/// The features as lines, in the coordinates of the file. Reports kLinesGeometry, kLinesCoordinates,
/// kLinesProperty.
std::vector<DrawnLine> read_edit_features(const Json& features, EditReport& report);

/// The coordinates of lines in a file that does not say: those in which more of them lie on lines of the
/// base, else those in which more lie in the scan, else local ones, as in files of before. Warns which it
/// took, where it matters.
LineCoordinates judge_coordinates(const std::vector<DrawnLine>& drawn, const WallLines& base,
                                  EditReport& report);

/// "features[17]" or "features[17] (wall_id w0017)".
std::string feature_place(std::size_t index, const std::string& id, const char* id_property = kLinesEdit.id);

/// Below it a line has no direction worth the name [m].
inline constexpr double kShortestLine_m = 1e-3;

/// Where a line of an edit may lie: the base's box, enlarged by half its diagonal. Local metres.
struct PlanBox {
  Vec2 low, high;
  bool holds(const Vec2& p) const;  ///< NaN is nowhere
};
PlanBox allowed_box(const Vec2& bbox_min, const Vec2& bbox_max);

/// Why places between `low` and `high`, in the coordinates of the file, lie outside, and what to do.
struct OutsideCause {
  std::string what, hint;
};
OutsideCause outside_cause(const Vec2& low, const Vec2& high, const PlanBox& allowed, const EditPlan& plan,
                           const Frame& base_frame);

/// Reports kLinesOutside for lines (in the coordinates of the file) far outside the base's box, naming the
/// likely cause, and kLinesDegenerate.
void check_edit_extent(const std::vector<DrawnLine>& drawn, const EditPlan& plan, const WallLines& base,
                       EditReport& report);

/// Gives ids, decides what is detected, edited or added, and takes from the base what editors drop. Result
/// sorted by id.
std::vector<WallLine> identify_lines(std::vector<DrawnLine> drawn, const WallLines& base, EditReport& report);

}  // namespace roomcut
