// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/wall_arc.h"

#include <charconv>
#include <cmath>

#include "common/artefact/json_values.h"
#include "common/geometry/scan_coordinates.h"

namespace roomcut {

namespace {

std::optional<double> number_in(const Json& properties, const char* name) {
  const auto found = properties.find(name);
  if (found == properties.end()) return std::nullopt;
  double value = 0;
  if (found->is_number()) {
    value = found->get<double>();
  } else if (found->is_string()) {
    const std::string text = found->get<std::string>();
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  } else {
    return std::nullopt;
  }
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

double rounded(double metres) {
  return std::round(metres * 1e6) / 1e6;
}

}  // namespace

std::optional<WallArc> arc_of(const WallLine& line, const Frame& frame) {
  const Json properties = parse_json(line.extra_json);
  const auto id = properties.find(kArcProperties[0]);
  const std::optional<double> x = number_in(properties, kArcProperties[1]);
  const std::optional<double> y = number_in(properties, kArcProperties[2]);
  const std::optional<double> radius = number_in(properties, kArcProperties[3]);
  if (id == properties.end() || !id->is_string() || !x || !y || !radius || *radius <= 0) {
    return std::nullopt;
  }
  return WallArc{id->get<std::string>(), ScanCoordinates(frame).plan_to_local({*x, *y}), *radius};
}

void set_arc(WallLine& line, const std::optional<WallArc>& arc, const Frame& frame) {
  Json properties = parse_json(line.extra_json);
  for (const char* name : kArcProperties) properties.erase(name);
  if (arc) {
    const Vec2 centre = ScanCoordinates(frame).plan_to_scan(arc->centre);
    properties[kArcProperties[0]] = arc->id;
    properties[kArcProperties[1]] = rounded(centre.x());
    properties[kArcProperties[2]] = rounded(centre.y());
    properties[kArcProperties[3]] = rounded(arc->radius_m);
  }
  line.extra_json = canonical_json(properties);
}

}  // namespace roomcut
