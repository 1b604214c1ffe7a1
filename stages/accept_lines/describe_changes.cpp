// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/accept_lines/describe_changes.h"

#include <algorithm>
#include <array>
#include <cmath>
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

std::string describe_id(const std::vector<WallLine>& lines, const std::string& id) {
  const auto found =
      std::find_if(lines.begin(), lines.end(), [&](const WallLine& line) { return line.id == id; });
  return found == lines.end() ? id : describe(*found);
}

}  // namespace

std::string describe(const WallLine& line) {
  return line.id + " (" + number(line.length(), 2) + " m, from " + point(line.a) + " to " + point(line.b) +
         ")";
}

std::string describe(const LineMove& move) {
  constexpr double kNothing_m = 5e-4;
  const double turn = move.angle_rad * 180.0 / std::numbers::pi;
  if (move.offset_m < kNothing_m && turn < 5e-3) {
    return move.id + " kept its place, its ends moved by " + number(move.ends_m, 3) + " m";
  }
  return move.id + " moved by " + number(move.offset_m, 3) + " m, turned by " + number(turn, 2) + " deg";
}

std::vector<std::string> describe_changes(const LineDifferences& changes,
                                          const std::vector<WallLine>& detected,
                                          const std::vector<WallLine>& edited) {
  std::vector<std::string> text;
  for (const LineMove& move : changes.moved) {
    text.push_back("moved:   " + describe(move));
  }
  for (const std::string& id : changes.added) {
    text.push_back("added:   " + describe_id(edited, id));
  }
  for (const std::string& id : changes.deleted) {
    text.push_back("deleted: " + describe_id(detected, id));
  }
  const auto locked =
      std::count_if(edited.begin(), edited.end(), [](const WallLine& line) { return line.locked; });
  text.push_back(std::to_string(changes.same.size()) + " as detected, " +
                 std::to_string(changes.moved.size()) + " moved, " + std::to_string(changes.added.size()) +
                 " added, " + std::to_string(changes.deleted.size()) + " deleted, " + std::to_string(locked) +
                 " locked");
  return text;
}

std::string describe_moved_base(const Acceptance& acceptance, const std::string& detection_sha256,
                                std::size_t most) {
  std::vector<std::string> items;
  for (const WallLine& line : acceptance.only_detected) {
    items.push_back("only the detection has " + describe(line));
  }
  for (const WallLine& line : acceptance.only_edited) {
    items.push_back("only the edit has       " + describe(line));
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

}  // namespace roomcut
