// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/compare/comparison_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "common/wall_lines/describe_changes.h"

namespace roomcut::compare {

namespace {

constexpr double kShownMove_m = 0.001, kShownArea_m2 = 0.005, kShownVolume_m3 = 0.01;

std::string signed_number(double value, int decimals) {
  const std::string text = fixed_number(value, decimals);
  return value > 0 && text.find_first_not_of("0.") != std::string::npos ? "+" + text : text;
}

bool is_count(const std::string& name) {
  return !name.ends_with("_m2") && !name.ends_with("_m3");
}

/// "area_m2" as "area [m2]".
std::string readable(std::string name) {
  for (const char* unit : {"m2", "m3"}) {
    if (const std::string ending = std::string("_") + unit; name.ends_with(ending)) {
      name = name.substr(0, name.size() - ending.size()) + " [" + unit + "]";
    }
  }
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::optional<double> value_of(const RunFacts& run, const std::string& name) {
  for (const auto& [known, value] : run.totals) {
    if (known == name) {
      return value;
    }
  }
  return std::nullopt;
}

}  // namespace

std::string fixed_number(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  const std::string out = text.data();
  return out.starts_with("-") && out.find_first_not_of("-0.") == std::string::npos ? out.substr(1) : out;
}

bool is_number(const std::string& word) {
  return !word.empty() && word.find_first_not_of("0123456789.+-") == std::string::npos;
}

WordTable parameter_rows(const Comparison& comparison) {
  WordTable table{"Parameters", {"parameter", "A", "B"}, {}, ""};
  for (const auto& [parameter, a, b] : comparison.parameters) {
    table.rows.push_back({parameter, a.empty() ? "-" : a, b.empty() ? "-" : b});
  }
  return table;
}

WordTable total_rows(const RunFacts& a, const RunFacts& b, bool all) {
  WordTable table{"Figures", {"", "A", "B", "B - A"}, {}, ""};
  for (const auto& [name, first] : a.totals.empty() ? b.totals : a.totals) {
    const auto in_a = value_of(a, name), in_b = value_of(b, name);
    const int decimals = is_count(name) ? 0 : 2;
    if (!all && in_a == in_b) {
      continue;
    }
    table.rows.push_back({readable(name), in_a ? fixed_number(*in_a, decimals) : "-",
                          in_b ? fixed_number(*in_b, decimals) : "-",
                          in_a && in_b ? signed_number(*in_b - *in_a, decimals) : ""});
  }
  return table;
}

WordTable distance_rows(const std::optional<ModelDistance>& distance) {
  WordTable table{"Distance between the models",
                  {"", "mean [mm]", "rms [mm]", "95 % below [mm]", "largest [mm]"},
                  {},
                  ""};
  if (!distance) {
    table.note = "One of the two has no model.";
    return table;
  }
  for (const auto& [name, way] :
       {std::pair{"from B to A", distance->b_to_a}, {"from A to B", distance->a_to_b}}) {
    table.rows.push_back({name, fixed_number(1e3 * way.mean_m, 1), fixed_number(1e3 * way.rms_m, 1),
                          fixed_number(1e3 * way.p95_m, 1), fixed_number(1e3 * way.hausdorff_m, 1)});
  }
  if (distance->common_m3 > 0) {
    table.note = "Empty in A only: " + fixed_number(distance->a_m3 - distance->common_m3, 2) +
                 " m3, in B only: " + fixed_number(distance->b_m3 - distance->common_m3, 2) +
                 " m3, in both: " + fixed_number(distance->common_m3, 2) + " m3.";
  }
  return table;
}

WordTable line_rows(const RunFacts& a, const RunFacts& b, const Comparison& comparison, std::size_t most) {
  WordTable table{"Wall lines", {"A", "B", "", "offset [mm]", "turn [deg]", "ends [mm]"}, {}, ""};
  const LineMatches& lines = comparison.lines;
  const auto b_lines = lines_in(b, a.frame);
  const ScanCoordinates scan(a.frame);
  std::size_t moved = 0;
  for (const LinePair& pair : lines.pairs) {
    if (pair.move.offset_m < kShownMove_m && pair.move.ends_m < 10 * kShownMove_m) {
      continue;
    }
    if (++moved <= most) {
      table.rows.push_back({a.lines[pair.a].id, b_lines[pair.b].id,
                            pair.move.offset_m < kShownMove_m ? "only its ends" : "moved",
                            fixed_number(1e3 * pair.move.offset_m, 1),
                            fixed_number(pair.move.angle_rad * 180 / std::numbers::pi, 3),
                            fixed_number(1e3 * pair.move.ends_m, 1)});
    }
  }
  for (const std::size_t i : lines.only_a) {
    table.rows.push_back({describe(a.lines[i], scan), "", "only in A", "", "", ""});
  }
  for (const std::size_t k : lines.only_b) {
    table.rows.push_back({"", describe(b_lines[k], scan), "only in B", "", "", ""});
  }
  table.note = std::to_string(lines.same()) + " the same, " +
               std::to_string(lines.pairs.size() - lines.same()) + " moved (" + std::to_string(moved) +
               " by more than 1 mm, or their ends by 10 mm), " + std::to_string(lines.only_a.size()) +
               " only in A, " + std::to_string(lines.only_b.size()) + " only in B.";
  return table;
}

WordTable room_rows(const RunFacts& a, const RunFacts& b, const Comparison& comparison) {
  WordTable table{
      "Rooms", {"A", "B", "storey", "area A [m2]", "area B [m2]", "volume A [m3]", "volume B [m3]"}, {}, ""};
  std::size_t alike = 0;
  for (const auto& [i, k] : comparison.rooms.both) {
    const SpaceFacts &in_a = a.rooms[i], &in_b = b.rooms[k];
    if (std::abs(in_a.area_m2 - in_b.area_m2) < kShownArea_m2 &&
        std::abs(in_a.volume_m3 - in_b.volume_m3) < kShownVolume_m3) {
      ++alike;
      continue;
    }
    table.rows.push_back({std::to_string(in_a.number), std::to_string(in_b.number),
                          std::to_string(in_a.storey), fixed_number(in_a.area_m2, 2),
                          fixed_number(in_b.area_m2, 2), fixed_number(in_a.volume_m3, 2),
                          fixed_number(in_b.volume_m3, 2)});
  }
  for (const std::size_t i : comparison.rooms.only_a) {
    const SpaceFacts& room = a.rooms[i];
    table.rows.push_back({std::to_string(room.number), "", std::to_string(room.storey),
                          fixed_number(room.area_m2, 2), "", fixed_number(room.volume_m3, 2), ""});
  }
  for (const std::size_t k : comparison.rooms.only_b) {
    const SpaceFacts& room = b.rooms[k];
    table.rows.push_back({"", std::to_string(room.number), std::to_string(room.storey), "",
                          fixed_number(room.area_m2, 2), "", fixed_number(room.volume_m3, 2)});
  }
  table.note = std::to_string(alike) + " alike in both.";
  return table;
}

}  // namespace roomcut::compare
