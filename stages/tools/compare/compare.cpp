// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/compare/compare.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>

#include "common/geometry/scan_coordinates.h"

namespace roomcut::compare {

namespace {

constexpr double kMostTurn = 5 * std::numbers::pi / 180;
constexpr double kMostOffset_m = 0.3;
constexpr double kLeastOverlap = 1.0 / 3;  // of the shorter line
constexpr double kMostApart_m = 1;         // of the centres of rooms, and of floors

/// How alike two things are, 0 = the same; empty: not the same thing.
using Unlikeness = std::function<std::optional<double>(std::size_t a, std::size_t b)>;

/// The likest pair first, then the likest of what is left. Ties go to the lower indices.
Matches match(std::size_t count_a, std::size_t count_b, const Unlikeness& unlikeness) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  for (std::size_t a = 0; a < count_a; ++a) {
    for (std::size_t b = 0; b < count_b; ++b) {
      if (const auto value = unlikeness(a, b)) {
        candidates.emplace_back(*value, a, b);
      }
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> taken_a(count_a, false), taken_b(count_b, false);
  Matches matches;
  for (const auto& [value, a, b] : candidates) {
    if (!taken_a[a] && !taken_b[b]) {
      taken_a[a] = taken_b[b] = true;
      matches.both.emplace_back(a, b);
    }
  }
  const auto left = [](const std::vector<bool>& taken) {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < taken.size(); ++i) {
      if (!taken[i]) {
        out.push_back(i);
      }
    }
    return out;
  };
  std::sort(matches.both.begin(), matches.both.end());
  matches.only_a = left(taken_a);
  matches.only_b = left(taken_b);
  return matches;
}

/// The length over which two nearly parallel lines run beside each other [m].
double overlap(const WallLine& a, const WallLine& b) {
  const Vec2 along = (a.b - a.a) / a.length();
  const double t0 = along.dot(b.a - a.a), t1 = along.dot(b.b - a.a);
  return std::min(a.length(), std::max(t0, t1)) - std::max(0.0, std::min(t0, t1));
}

std::optional<double> line_unlikeness(const WallLine& a, const WallLine& b) {
  const LineMove move = move_between(a, b);
  if (move.offset_m > kMostOffset_m || move.angle_rad > kMostTurn ||
      overlap(a, b) < kLeastOverlap * std::min(a.length(), b.length())) {
    return std::nullopt;
  }
  // The ends break ties between pieces of one row.
  return move.offset_m + 0.5 * a.length() * move.angle_rad + 0.01 * move.ends_m;
}

std::vector<ParameterDifference> parameter_differences(const RunFacts& a, const RunFacts& b) {
  const auto value_of = [](const RunFacts& run, const std::string& name) {
    const auto found = std::find_if(run.parameters.begin(), run.parameters.end(),
                                    [&](const auto& parameter) { return parameter.first == name; });
    return found == run.parameters.end() ? std::string() : found->second;
  };
  std::vector<ParameterDifference> list;
  for (const auto& [name, value] : a.parameters) {
    if (const std::string other = value_of(b, name); other != value) {
      list.push_back({name, value, other});
    }
  }
  for (const auto& [name, value] : b.parameters) {
    if (value_of(a, name).empty()) {
      list.push_back({name, "", value});
    }
  }
  return list;
}

}  // namespace

std::size_t LineMatches::same() const {
  return static_cast<std::size_t>(
      std::count_if(pairs.begin(), pairs.end(), [](const LinePair& pair) { return pair.same(); }));
}

LineMatches match_lines(const std::vector<WallLine>& a, const std::vector<WallLine>& b) {
  const Matches matches =
      match(a.size(), b.size(), [&](std::size_t i, std::size_t k) { return line_unlikeness(a[i], b[k]); });
  LineMatches out;
  for (const auto& [i, k] : matches.both) {
    out.pairs.push_back({i, k, move_between(a[i], b[k])});
  }
  std::stable_sort(out.pairs.begin(), out.pairs.end(), [](const LinePair& p, const LinePair& q) {
    return std::tie(p.move.offset_m, p.move.ends_m) > std::tie(q.move.offset_m, q.move.ends_m);
  });
  out.only_a = matches.only_a;
  out.only_b = matches.only_b;
  return out;
}

Matches match_storeys(const std::vector<SpaceFacts>& a, const std::vector<SpaceFacts>& b) {
  return match(a.size(), b.size(), [&](std::size_t i, std::size_t k) -> std::optional<double> {
    const double apart = std::abs(a[i].floor_z - b[k].floor_z);
    return apart <= kMostApart_m ? std::optional(apart) : std::nullopt;
  });
}

Matches match_rooms(const std::vector<SpaceFacts>& a, const std::vector<SpaceFacts>& b) {
  return match(a.size(), b.size(), [&](std::size_t i, std::size_t k) -> std::optional<double> {
    const double apart = (a[i].centre - b[k].centre).norm();
    const bool near = apart <= kMostApart_m && std::abs(a[i].floor_z - b[k].floor_z) <= kMostApart_m;
    return near ? std::optional(apart) : std::nullopt;
  });
}

std::vector<WallLine> lines_in(const RunFacts& run, const Frame& frame) {
  const ScanCoordinates own(run.frame);
  const ScanCoordinates other(frame);
  std::vector<WallLine> lines = run.lines;
  for (WallLine& line : lines) {
    line.a = other.plan_to_local(own.plan_to_scan(line.a));
    line.b = other.plan_to_local(own.plan_to_scan(line.b));
  }
  return lines;
}

Comparison compare_runs(const RunFacts& a, const RunFacts& b) {
  Comparison out;
  out.same_scan = !a.scan_sha256.empty() && a.scan_sha256 == b.scan_sha256;
  out.parameters = parameter_differences(a, b);
  out.lines = match_lines(a.lines, lines_in(b, a.frame));
  out.storeys = match_storeys(a.storeys, b.storeys);
  out.rooms = match_rooms(a.rooms, b.rooms);
  return out;
}

}  // namespace roomcut::compare
