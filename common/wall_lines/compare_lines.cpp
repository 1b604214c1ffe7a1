// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/compare_lines.h"

#include <algorithm>
#include <cmath>

namespace roomcut {

namespace {

std::size_t find_id(const std::vector<WallLine>& lines, const std::string& id) {
  const auto found =
      std::find_if(lines.begin(), lines.end(), [&](const WallLine& line) { return line.id == id; });
  return static_cast<std::size_t>(found - lines.begin());
}

}  // namespace

LineMove move_between(const WallLine& from, const WallLine& to) {
  const Line2 line = to.line();
  return {to.id, std::abs(line.distance(from.centre())), angle_between(line.theta, from.line().theta),
          end_distance(from, to)};
}

double end_distance(const WallLine& a, const WallLine& b) {
  const double straight = std::max((a.a - b.a).norm(), (a.b - b.b).norm());
  const double turned = std::max((a.a - b.b).norm(), (a.b - b.a).norm());
  return std::min(straight, turned);
}

std::string base_id(const std::string& id, const std::vector<WallLine>& base) {
  if (find_id(base, id) < base.size()) {
    return id;
  }
  const std::size_t dot = id.rfind('.');
  const bool piece = dot != std::string::npos && dot + 1 < id.size() &&
                     id.find_first_not_of("0123456789", dot + 1) == std::string::npos;
  if (piece && find_id(base, id.substr(0, dot)) < base.size()) {
    return id.substr(0, dot);
  }
  return "";
}

LineDifferences compare_lines(const std::vector<WallLine>& base, const std::vector<WallLine>& lines) {
  LineDifferences result;
  std::vector<bool> met(base.size(), false);
  std::vector<const WallLine*> without_id;
  for (const WallLine& line : lines) {
    const std::size_t index = find_id(base, line.id);
    if (index == base.size()) {
      without_id.push_back(&line);
      continue;
    }
    met[index] = true;
    if (same_geometry(base[index], line)) {
      result.same.push_back(line.id);
    } else {
      result.moved.push_back(move_between(base[index], line));
    }
  }
  for (const WallLine* line : without_id) {
    std::size_t index = 0;
    while (index < base.size() && (met[index] || !same_geometry(base[index], *line))) {
      ++index;
    }
    if (index < base.size()) {
      met[index] = true;
      result.same.push_back(line->id);
    } else {
      result.added.push_back(line->id);
    }
  }
  for (std::size_t i = 0; i < base.size(); ++i) {
    if (!met[i]) {
      result.deleted.push_back(base[i].id);
    }
  }
  std::sort(result.same.begin(), result.same.end());
  return result;
}

}  // namespace roomcut
