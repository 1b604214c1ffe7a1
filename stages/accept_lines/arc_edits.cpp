// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/accept_lines/arc_edits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "common/wall_lines/compare_lines.h"
#include "common/wall_lines/wall_arc.h"

namespace roomcut::accept_lines {

namespace {

constexpr double kSameArc_m = 2e-6;  // the files' resolution, twice

bool same(const WallArc& a, const WallArc& b) {
  return (a.centre - b.centre).norm() <= kSameArc_m && std::abs(a.radius_m - b.radius_m) <= kSameArc_m;
}

/// A chord that lies where the detection has it, with the arc there and here.
struct Chord {
  WallLine* line;
  WallArc was, is;
};

const WallLine* find_line(const std::vector<WallLine>& lines, const std::string& id) {
  const auto found =
      std::lower_bound(lines.begin(), lines.end(), id,
                       [](const WallLine& line, const std::string& key) { return line.id < key; });
  return found != lines.end() && found->id == id ? &*found : nullptr;
}

/// The point as far out on the new arc as it was on the old one, at its azimuth.
Vec2 moved(const Vec2& p, const WallArc& was, const WallArc& is) {
  return is.centre + (p - was.centre) * (is.radius_m / was.radius_m);
}

std::string remade(const WallArc& arc, std::size_t chords) {
  return "the " + std::to_string(chords) + " chords of arc " + arc.id +
         " are made anew: its radius or centre was edited";
}

}  // namespace

std::vector<std::string> apply_arc_edits(const WallLines& detected, WallLines& edit) {
  std::map<std::string, std::vector<Chord>> arcs;
  for (WallLine& line : edit.lines) {
    const std::optional<WallArc> is = arc_of(line, edit.frame);
    const WallLine* original = find_line(detected.lines, line.id);
    const std::optional<WallArc> was = original ? arc_of(*original, detected.frame) : std::nullopt;
    if (is && was && is->id == was->id && same_geometry(line, *original)) {
      arcs[is->id].push_back({&line, *was, *is});
    } else {
      set_arc(line, std::nullopt, edit.frame);
    }
  }
  std::vector<std::string> said;
  for (const auto& [id, chords] : arcs) {
    std::vector<const Chord*> changed;
    for (const Chord& chord : chords) {
      if (!same(chord.was, chord.is)) changed.push_back(&chord);
    }
    if (changed.empty()) continue;
    const WallArc arc = changed.front()->is;
    if (std::any_of(changed.begin(), changed.end(), [&](const Chord* c) { return !same(c->is, arc); })) {
      said.push_back("arc " + id + " has different radii or centres; those of " + changed.front()->line->id +
                     " count");
    }
    for (const Chord& chord : chords) {
      WallLine& line = *chord.line;
      line.a = moved(line.a, chord.was, arc);
      line.b = moved(line.b, chord.was, arc);
      line.source = LineSource::kEdited;
      line.support_m = line.length();
      line.rms_m = line.sigma_offset_m = line.sigma_angle_rad = 0;
      set_arc(line, arc, edit.frame);
    }
    said.push_back(remade(arc, chords.size()));
  }
  return said;
}

}  // namespace roomcut::accept_lines
