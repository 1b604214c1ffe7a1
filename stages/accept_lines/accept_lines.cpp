// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/accept_lines/accept_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/wall_lines/describe_changes.h"
#include "stages/accept_lines/arc_edits.h"

namespace roomcut::accept_lines {

namespace {

constexpr double kNear_m = 0.03;
constexpr double kNear_rad = 2.0 * std::numbers::pi / 180.0;

bool near(const WallLine& line, const WallLine& other) {
  const Line2 base = line.line();
  if (angle_between(base.theta, other.line().theta) > kNear_rad) {
    return false;
  }
  const auto [low, high] = std::minmax({base.along(other.a), base.along(other.b)});
  const auto [first, last] = std::minmax({base.along(line.a), base.along(line.b)});
  const double from = std::max(low, first);
  const double to = std::min(high, last);
  const Vec2 middle = base.at(0.5 * (from + to));  // of the common stretch
  return to > from && std::abs(other.line().distance(middle)) <= kNear_m;
}

}  // namespace

std::vector<WallLine> without_partner(const std::vector<WallLine>& lines,
                                      const std::vector<WallLine>& others) {
  std::vector<WallLine> alone;
  for (const WallLine& line : lines) {
    if (std::none_of(others.begin(), others.end(),
                     [&](const WallLine& other) { return near(line, other); })) {
      alone.push_back(line);
    }
  }
  return alone;
}

Acceptance accept_lines(const WallLines& detected, const std::string& detection_sha256,
                        const std::optional<WallLines>& edit) {
  Acceptance result;
  result.lines = edit ? *edit : detected;
  if (edit) {
    result.arcs = apply_arc_edits(detected, result.lines);
  }
  result.base_moved = edit && !edit->base_sha256.empty() && edit->base_sha256 != detection_sha256;
  if (!result.base_moved) {
    result.lines.base_sha256 = detection_sha256;
  } else {
    result.only_detected = without_partner(detected.lines, edit->lines);
    result.only_edited = without_partner(edit->lines, detected.lines);
  }
  if (edit) {
    result.changes = compare_lines(detected.lines, result.lines.lines);
  }
  const auto locked = [](const WallLine& line) { return line.locked; };
  result.locked =
      static_cast<int>(std::count_if(result.lines.lines.begin(), result.lines.lines.end(), locked));
  return result;
}

std::string describe_moved_base(const Acceptance& acceptance, const std::string& detection_sha256,
                                std::size_t most) {
  const ScanCoordinates scan(acceptance.lines.frame);
  std::vector<std::string> items;
  for (const WallLine& line : acceptance.only_detected) {
    items.push_back("only the detection has " + describe(line, scan));
  }
  for (const WallLine& line : acceptance.only_edited) {
    items.push_back("only the edit has       " + describe(line, scan));
  }
  std::string text =
      "the detection changed since the edit began; the edit stays in force, check it (when done, write "
      "\"base_sha256\": \"" +
      detection_sha256 + "\" into its member `roomcut`)";
  for (std::size_t i = 0; i < std::min(most, items.size()); ++i) {
    text += "\n  " + items[i];
  }
  if (items.size() > most) {
    text += "\n  … and " + std::to_string(items.size() - most) + " more (make diff-lines)";
  }
  return items.empty() ? text + "\n  every line still has its partner" : text;
}

}  // namespace roomcut::accept_lines
