// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/curved_walls.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "common/wall_lines/wall_arc.h"

namespace roomcut::extract {

namespace {

constexpr double kLeastArea_m2 = 0.2;
constexpr double kTurn = 2 * std::numbers::pi;

/// What is known of an arc while its edges are gone through.
struct Found {
  WallArc arc;
  double area_m2 = 0, z0 = 1e9, z1 = -1e9;
  std::set<int> storeys;
  std::set<std::string> wall_ids;
  std::vector<double> azimuths;  ///< of the ends of its edges
};

double azimuth(const Vec2& p, const Vec2& centre) {
  return std::atan2(p.y() - centre.y(), p.x() - centre.x());
}

/// The azimuths that are left when the widest gap between `azimuths` is taken out; of a whole circle, whose
/// widest gap is one chord, all.
std::pair<double, double> span_of(std::vector<double> azimuths, double chord) {
  std::sort(azimuths.begin(), azimuths.end());
  double from = azimuths.front(), gap = 0;
  for (std::size_t k = 0; k < azimuths.size(); ++k) {
    const double next = k + 1 < azimuths.size() ? azimuths[k + 1] : azimuths.front() + kTurn;
    if (next - azimuths[k] > gap) {
      gap = next - azimuths[k];
      from = next;
    }
  }
  from = std::remainder(from, kTurn);
  return {from, from + (gap <= 1.5 * chord ? kTurn : kTurn - gap)};
}

/// Whether p, which lies on the chord's line, lies on the chord: beyond it the line may carry something else.
bool is_part(const WallLine& chord, const Vec2& p) {
  const double t = (p - chord.a).dot((chord.b - chord.a).normalized());
  return t >= 0 && t <= chord.length();
}

double chord_angle(const WallLine& chord, const Vec2& centre) {
  return 2 * std::asin(std::min(1.0, 0.5 * chord.length() / (chord.a - centre).norm()));
}

}  // namespace

std::vector<CurvedWall> find_curved_walls(const WallLines& lines, const CellComplex& complex,
                                          const std::vector<std::uint8_t>& label,
                                          const std::vector<std::int16_t>& storey) {
  std::map<std::string, Found> arcs;
  std::map<std::string, double> chord;
  std::map<std::string, const WallLine*> chords;
  for (const WallLine& line : lines.lines) {
    if (const auto arc = arc_of(line, lines.frame)) {
      arcs[arc->id].arc = *arc;
      chord[arc->id] = std::max(chord[arc->id], chord_angle(line, arc->centre));
      chords[line.id] = &line;
    }
  }
  for (const CellComplex::Edge& edge : complex.edges) {
    if (arcs.empty() || edge.line < 0 || edge.left < 0 || edge.right < 0) continue;
    const std::string& wall_id = complex.lines[static_cast<std::size_t>(edge.line)].wall_id;
    const auto named = chords.find(wall_id);
    if (named == chords.end()) continue;
    Found& found = arcs.at(arc_of(*named->second, lines.frame)->id);
    const Vec2 a = complex.vertices[static_cast<std::size_t>(edge.v0)];
    const Vec2 b = complex.vertices[static_cast<std::size_t>(edge.v1)];
    if (!is_part(*named->second, 0.5 * (a + b))) continue;
    for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
      const std::size_t left = complex.cell(static_cast<std::size_t>(edge.left), layer);
      const std::size_t right = complex.cell(static_cast<std::size_t>(edge.right), layer);
      if (is_empty(label, left) == is_empty(label, right)) continue;
      found.area_m2 += (b - a).norm() * (complex.levels[layer + 1] - complex.levels[layer]);
      found.z0 = std::min(found.z0, complex.levels[layer]);
      found.z1 = std::max(found.z1, complex.levels[layer + 1]);
      found.storeys.insert(storey[is_empty(label, left) ? left : right]);
      found.wall_ids.insert(wall_id);
      found.azimuths.push_back(azimuth(a, found.arc.centre));
      found.azimuths.push_back(azimuth(b, found.arc.centre));
    }
  }
  std::vector<CurvedWall> walls;
  for (const auto& [id, found] : arcs) {
    if (found.area_m2 < kLeastArea_m2) continue;
    const auto [from, to] = span_of(found.azimuths, chord.at(id));
    walls.push_back({id,
                     found.arc.centre,
                     found.arc.radius_m,
                     from,
                     to,
                     found.z0,
                     found.z1,
                     found.area_m2,
                     {found.storeys.begin(), found.storeys.end()},
                     {found.wall_ids.begin(), found.wall_ids.end()}});
  }
  return walls;
}

}  // namespace roomcut::extract
