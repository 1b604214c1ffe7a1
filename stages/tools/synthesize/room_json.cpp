// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/room_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "stages/tools/synthesize/column.h"
#include "stages/tools/synthesize/room_heights.h"
#include "stages/tools/synthesize/scene_limits.h"

namespace roomcut::synthesize {

using nlohmann::json;

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSameCircle = 1e-6;  // [m]
constexpr double kSteepest = 75;      // of slopes [degrees]

class ElementReader {
 public:
  ElementReader(SceneNode& node, SceneRoom& room) : node_(node), room_(room) {}

  void read() {
    each("slopes", &ElementReader::read_slope);
    if (const json* value = node_.member("roof")) read_roof(*value, node_.path("roof"));
    if (room_.slopes.size() > scene_limits::kSlopes) {
      node_.problem("more than " + std::to_string(scene_limits::kSlopes) + " slopes, the roof's among them",
                    "divide the room, or leave some out");
      room_.slopes.clear();
    }
    each("columns", &ElementReader::read_column);
    each("niches", &ElementReader::read_niche);
  }

 private:
  void each(const char* key, void (ElementReader::*read_one)(const json&, const std::string&)) {
    const json& items = node_.list(key);
    for (std::size_t i = 0; i < items.size(); ++i) {
      (this->*read_one)(items[i], node_.path(key) + "[" + std::to_string(i) + "]");
    }
  }

  void read_slope(const json& value, const std::string& path) {
    SceneNode node(value, path, node_.problems());
    const bool ceiling = node.choice("of", "ceiling", {"ceiling", "floor"}) == "ceiling";
    const Vec2 at = node.point("at");
    const double z = node.required_number("z", -1e4, 1e4);
    const double pitch = node.number("pitch_deg", 0, 0, kSteepest);
    const double azimuth = node.number("azimuth_deg", 0, -360, 360);
    SceneSlope slope = sloped(ceiling, {at.x(), at.y(), z}, pitch * kDegree, azimuth * kDegree);
    if (node.has("polygon")) slope.polygon = node.polygon("polygon");
    room_.slopes.push_back(std::move(slope));
  }

  void read_roof(const json& value, const std::string& path) {
    SceneNode node(value, path, node_.problems());
    const std::string kind = node.choice("kind", "gable", {"monopitch", "gable", "hip"});
    const double pitch = node.required_number("pitch_deg", 0, kSteepest);
    const double azimuth = node.number("azimuth_deg", 0, -360, 360);
    const double eaves = node.required_number("eaves", 0, 1e4);
    const Polygon2 footprint = node.has("footprint") ? node.polygon("footprint") : room_.polygon;
    if (footprint.empty()) return;
    const RoofKind roof_kind = kind == "monopitch" ? RoofKind::kMonopitch
                               : kind == "gable"   ? RoofKind::kGable
                                                   : RoofKind::kHip;
    for (SceneSlope& slope :
         roof(roof_kind, footprint, pitch * kDegree, azimuth * kDegree, room_.floor + eaves)) {
      room_.slopes.push_back(std::move(slope));
    }
  }

  void read_column(const json& value, const std::string& path) {
    SceneNode node(value, path, node_.problems());
    const bool round = node.choice("shape", "rectangular", {"rectangular", "round"}) == "round";
    const Vec2 at = node.point("at");
    const double width = node.required_number("width", 0.05, 10);
    const double depth = round ? width : node.number("depth", width, 0.05, 10);
    const double rotation = node.number("rotation_deg", 0, -360, 360) * kDegree;
    room_.columns.push_back(round ? round_column(at, width) : rectangular_column(at, width, depth, rotation));
  }

  void read_niche(const json& value, const std::string& path) {
    SceneNode node(value, path, node_.problems());
    SceneNiche niche;
    niche.at = node.point("at");
    niche.width = node.number("width", niche.width, 0.05, 50);
    niche.depth = node.number("depth", niche.depth, -2, 2);
    niche.sill = node.number("sill", niche.sill, 0, 50);
    niche.height = node.number("height", niche.height, 0, 50);
    if (std::abs(niche.depth) < 0.01) node.problem("\"depth\" is less than 1 cm");
    if (niche.depth < 0 && (niche.sill > 0 || niche.height > 0)) {
      node.problem("a pilaster (depth < 0) stands from floor to ceiling: no \"sill\", no \"height\"");
    }
    room_.niches.push_back(niche);
  }

  SceneNode& node_;
  SceneRoom& room_;
};

/// The circle through the corners first, …, last of a polygon; those at the ends may have been moved by an
/// inset.
SceneArc arc_through(const Polygon2& polygon, std::size_t first, std::size_t last) {
  const auto corner = [&](std::size_t i) { return polygon[i % polygon.size()]; };
  const Vec2 a = corner(first + 1);
  const Vec2 ab = corner((first + last) / 2) - a;
  const Vec2 ac = corner(last - 1) - a;
  const double d = 2 * (ab.x() * ac.y() - ab.y() * ac.x());
  const Vec2 to_centre(ac.y() * ab.squaredNorm() - ab.y() * ac.squaredNorm(),
                       ab.x() * ac.squaredNorm() - ac.x() * ab.squaredNorm());
  SceneArc arc{a + to_centre / d, to_centre.norm() / std::abs(d), corner(first), corner(last), d > 0};
  if (!arc.bulges) std::swap(arc.from, arc.to);
  return arc;
}

/// Lengthens the last arc when the new one goes on with its circle.
void add_arc(const SceneArc& arc, std::vector<SceneArc>& arcs) {
  const bool goes_on = !arcs.empty() && arcs.back().bulges == arc.bulges &&
                       (arcs.back().centre - arc.centre).norm() < kSameCircle &&
                       std::abs(arcs.back().radius - arc.radius) < kSameCircle;
  if (!goes_on) {
    arcs.push_back(arc);
  } else if (arc.bulges) {
    arcs.back().to = arc.to;
  } else {
    arcs.back().from = arc.from;
  }
}

}  // namespace

std::vector<SceneArc> arcs_of(const Polygon2& polygon, const std::vector<std::size_t>& side) {
  std::vector<SceneArc> arcs;
  const std::size_t n = side.size();
  std::size_t start = 0;  // a run may go on past the polygon's first corner
  while (start + 1 < n && side[start] == side[(start + n - 1) % n]) ++start;
  for (std::size_t first = start; first < start + n;) {
    std::size_t last = first;
    while (last < start + n && side[last % n] == side[first % n]) ++last;
    if (last - first >= 4) add_arc(arc_through(polygon, first, last), arcs);
    first = last;
  }
  return arcs;
}

void read_room_elements(SceneNode& node, SceneRoom& room) {
  ElementReader(node, room).read();
}

}  // namespace roomcut::synthesize
