// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/describe_changes.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numbers>

namespace roomcut {

namespace {

std::string number(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value == 0 ? 0.0 : value);
  return text.data();
}

std::string point(const Vec2& p) {
  return "(" + number(p.x(), 2) + ", " + number(p.y(), 2) + ")";
}

std::string describe_id(const std::vector<WallLine>& lines, const std::string& id,
                        const ScanCoordinates& scan) {
  const auto found =
      std::find_if(lines.begin(), lines.end(), [&](const WallLine& line) { return line.id == id; });
  return found == lines.end() ? id : describe(*found, scan);
}

}  // namespace

std::string describe(const WallLine& line, const ScanCoordinates& scan) {
  return line.id + " (" + number(line.length(), 2) + " m, from " + point(scan.plan_to_scan(line.a)) + " to " +
         point(scan.plan_to_scan(line.b)) + ")";
}

std::string describe(const LineMove& move) {
  constexpr double kNothing_m = 5e-4;
  const double turn = move.angle_rad * 180.0 / std::numbers::pi;
  if (move.offset_m < kNothing_m && turn < 5e-3) {
    return move.id + " kept its place, its ends moved by " + number(1e3 * move.ends_m, 1) + " mm";
  }
  return move.id + " moved by " + number(1e3 * move.offset_m, 1) + " mm, turned by " + number(turn, 2) +
         " deg";
}

std::vector<std::string> describe_changes(const LineDifferences& changes,
                                          const std::vector<WallLine>& detected,
                                          const std::vector<WallLine>& edited, const Frame& frame) {
  const ScanCoordinates scan(frame);
  std::vector<std::string> text;
  for (const LineMove& move : changes.moved) {
    text.push_back("moved:   " + describe(move));
  }
  for (const std::string& id : changes.added) {
    text.push_back("added:   " + describe_id(edited, id, scan));
  }
  for (const std::string& id : changes.deleted) {
    text.push_back("deleted: " + describe_id(detected, id, scan));
  }
  std::size_t locked = 0;
  for (const WallLine& line : edited) {
    if (line.locked) {
      text.push_back("locked:  " + describe(line, scan));
      ++locked;
    }
  }
  text.push_back(std::to_string(changes.same.size()) + " as detected, " +
                 std::to_string(changes.moved.size()) + " moved, " + std::to_string(changes.added.size()) +
                 " added, " + std::to_string(changes.deleted.size()) + " deleted, " + std::to_string(locked) +
                 " locked");
  return text;
}

}  // namespace roomcut
