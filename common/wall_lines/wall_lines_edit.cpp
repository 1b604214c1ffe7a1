// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/artefact_check.h"
#include "common/artefact/json_values.h"
#include "common/errors/codes.h"
#include "common/wall_lines/edit_document.h"
#include "common/wall_lines/wall_lines_format.h"
#include "common/wall_lines/wall_lines_io.h"

namespace roomcut {

WallLinesFile read_edited_wall_lines(const std::filesystem::path& path, const WallLines& base) {
  EditReport report;
  report.path = path.string();
  const Json document = read_edit_document(path, report);
  const EditOrigin origin = read_edit_member(document, base.frame, report);
  std::vector<DrawnLine> drawn = read_edit_features(document["features"], report);
  if (drawn.empty() && report.problems.empty()) {
    report.problem(errors::kLinesNone, "", "has no line left",
                   "draw one, or remove the file to go back to the detected lines (`make drop-edit`)");
  }
  const LineCoordinates coordinates =
      origin.coordinates ? *origin.coordinates : judge_coordinates(drawn, base, report);
  const EditPlan plan(coordinates, origin.frame, base.frame);
  check_edit_extent(drawn, plan, base, report);
  if (!report.problems.empty()) {
    throw StageError(report.problems);
  }
  for (DrawnLine& d : drawn) {
    d.line.a = plan.to_base(d.line.a);
    d.line.b = plan.to_base(d.line.b);
  }
  WallLinesFile file;
  file.content.frame = base.frame;
  file.content.bbox_min = base.bbox_min;
  file.content.bbox_max = base.bbox_max;
  file.content.base_sha256 = origin.base_sha256;
  file.content.lines = identify_lines(std::move(drawn), base, report);
  file.payload_sha256 = wall_lines_payload_sha256(file.content);
  file.warnings = std::move(report.warnings);
  return file;
}

}  // namespace roomcut
