// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/point_sorter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace roomcut::weigh_faces {

PointSorter::NearLevel PointSorter::nearest_level(double z) const {
  const std::vector<double>& levels = complex_.levels;
  std::size_t above = heights_.first_not_below(z);
  if (above == levels.size() || (above > 0 && z - levels[above - 1] <= levels[above] - z)) {
    --above;
  }
  const double dz = z - levels[above];
  double reach = std::numeric_limits<double>::infinity();
  if (dz > 0 && above + 1 < levels.size()) {
    reach = 0.5 * (levels[above + 1] - levels[above]);
  } else if (dz < 0 && above > 0) {
    reach = 0.5 * (levels[above] - levels[above - 1]);
  }
  return {above, dz, reach};
}

std::int32_t PointSorter::wall_of(SurfaceClass surface, std::uint8_t azimuth) const {
  std::int32_t best = -1;
  double best_e = tolerances_.wall_reach;
  if (surface == SurfaceClass::kWall) {
    for (const Candidate& c : candidates_) {
      if (std::abs(c.e) < best_e && line(c.line).faces[azimuth]) {
        best = c.line;
        best_e = std::abs(c.e);
      }
    }
  } else if (surface == SurfaceClass::kNone) {
    best = wall_of_unclassed();
  }
  return best;
}

std::int32_t PointSorter::wall_of_unclassed() const {
  const Candidate* best = nullptr;
  for (const Candidate& c : candidates_) {
    if (best == nullptr || std::abs(c.e) < std::abs(best->e)) {
      best = &c;
    }
  }
  if (best == nullptr || std::abs(best->e) >= tolerances_.wall_reach) {
    return -1;
  }
  for (const Candidate& c : candidates_) {
    if (c.line == best->line || std::abs(c.e) >= tolerances_.wall_alone) {
      continue;
    }
    // It could be either wall's where both lie within the noise. Elsewhere in a corner, and between the two
    // faces of a thin wall (voxels hold points of both and so have no plane), it is the wall's on which it
    // lies.
    const bool off_it = parallel(c.line, best->line) || std::abs(c.e) > tolerances_.wall_tight;
    const bool on_best = std::abs(best->e) < tolerances_.wall_tight && 2 * std::abs(best->e) < std::abs(c.e);
    if (!off_it || !on_best) {
      return -1;
    }
  }
  return best->line;
}

/// In sparse scans the neighbourhood of a wall's foot or head holds more of the floor or ceiling than of the
/// wall, and which of its points count as level depends on where its voxels begin. Off every level, what lies
/// on a line within the noise is the wall's.
std::int32_t PointSorter::wall_at_foot() const {
  const std::int32_t wall = wall_of_unclassed();
  const auto lies_on_it = [&](const Candidate& c) {
    return c.line == wall && std::abs(c.e) < tolerances_.wall_tight;
  };
  return std::any_of(candidates_.begin(), candidates_.end(), lies_on_it) ? wall : -1;
}

bool PointSorter::parallel(std::int32_t a, std::int32_t b) const {
  const double apart = std::abs(line(a).theta - line(b).theta);  // both in [0, pi): no remainder is needed
  return std::min(apart, std::numbers::pi - apart) <= tolerances_.azimuth;
}

void PointSorter::add_beside_walls(const Vec2& p, std::size_t level) {
  for (const Candidate& c : candidates_) {
    const double distance = std::abs(c.e);
    if (distance < tolerances_.beside_low || distance > tolerances_.beside_high) {
      continue;
    }
    // A parallel line at the point or between: the point speaks of that one, not of this.
    const Vec2 foot = p - c.e * line(c.line).normal;
    const bool hidden = std::any_of(candidates_.begin(), candidates_.end(), [&](const Candidate& other) {
      if (other.line == c.line || !parallel(other.line, c.line)) {
        return false;
      }
      return std::abs(other.e) < tolerances_.beside_low || other.e * line(other.line).distance(foot) < 0;
    });
    if (hidden) {
      continue;
    }
    walls_.add_level_beside(c.line, c.e > 0, line(c.line).along(p), level);
  }
}

void PointSorter::add_beside_levels(const Vec2& p, double z) {
  const std::vector<double>& levels = complex_.levels;
  const std::size_t above = heights_.first_not_below(z);
  const auto in_band = [this](double gap) {
    return gap >= tolerances_.over_low && gap <= tolerances_.over_high;
  };
  if (above > 0 && in_band(z - levels[above - 1])) {
    levels_.add_over(above - 1, p);
  }
  if (above < levels.size() && in_band(levels[above] - z)) {
    levels_.add_under(above, p);
  }
}

void PointSorter::add_inside(const Vec2& p, double z, const NearLevel& near) {
  const auto near_wall = [this](const Candidate& c) { return std::abs(c.e) < tolerances_.beside_low; };
  if (std::abs(near.dz) < tolerances_.over_low || z < complex_.levels.front() || z > complex_.levels.back() ||
      std::any_of(candidates_.begin(), candidates_.end(), near_wall)) {
    return;
  }
  const std::int64_t piece = levels_.faces().find(p);
  if (piece >= 0) {
    const auto face = static_cast<std::size_t>(levels_.faces().piece(static_cast<std::size_t>(piece)).face);
    inside_.add(complex_.cell(face, near.dz > 0 ? near.level : near.level - 1));
  }
}

void PointSorter::add(const Vec3& point, SurfaceClass surface, std::uint8_t azimuth) {
  const Vec2 p = point.head<2>();
  const double z = point.z();
  candidates_.clear();
  const NearLevel near = nearest_level(z);
  const std::size_t layer =
      std::min(near.dz < 0 && near.level > 0 ? near.level - 1 : near.level, complex_.layers() - 1);
  for (const std::int32_t index : lines_.near(p)) {
    if (line(index).carries[layer] != 0) {
      candidates_.push_back({index, line(index).distance(p)});
    }
  }
  const double off = std::abs(near.dz);
  // At a wall a point without a class, or of a sloped one, is the wall's: between the two faces of a thin
  // one, where noise mixes them, they would make a floor.
  const double clear = std::max(tolerances_.wall_reach, tolerances_.beside_low);
  const bool at_wall = std::any_of(candidates_.begin(), candidates_.end(),
                                   [&](const Candidate& c) { return std::abs(c.e) < clear; });
  if (const Slopes::Found on = slopes_.at(point); on.plane != nullptr && on.distance < off &&
                                                  surface != SurfaceClass::kWall &&
                                                  !(surface == SurfaceClass::kNone && at_wall)) {
    add_on_plane(p, on);
    return;
  }
  const bool flat =
      surface == SurfaceClass::kHorizontal && off < std::min(tolerances_.level_reach, near.reach);
  const bool foot = surface == SurfaceClass::kHorizontal && !flat;
  const std::int32_t wall = foot ? wall_at_foot() : wall_of(surface, azimuth);
  if (wall >= 0) {
    walls_.add_on(wall, line(wall).along(p), z);
  }
  const bool loose =
      surface == SurfaceClass::kNone && off < std::min(tolerances_.level_tight, near.reach) && !at_wall;
  const bool on_level = flat || loose;
  const bool sloped = tolerances_.slopes && surface == SurfaceClass::kSloped && !at_wall;
  if (on_level || sloped) {
    const std::int64_t found = levels_.faces().find(p);
    if (found >= 0) {
      const auto piece = static_cast<std::size_t>(found);
      if (on_level) {
        levels_.add_on(near.level, piece);
      } else {
        add_sloped(piece, near, layer, z);
      }
    }
  }
  if (on_level) {
    add_beside_walls(p, near.level);
  } else {
    add_beside_levels(p, z);
    if (wall < 0) {
      add_inside(p, z, near);
    }
  }
}

void PointSorter::add_on_plane(const Vec2& p, const Slopes::Found& on) {
  if (const std::int64_t piece = levels_.faces().find(p); piece >= 0) {
    if (on.plane->ceiling) {
      levels_.add_sloped(on.level, static_cast<std::size_t>(piece));
    } else {
      levels_.add_on(on.level, static_cast<std::size_t>(piece));
    }
  }
  add_beside_walls(p, on.level);
}

void PointSorter::add_sloped(std::size_t piece, const NearLevel& near, std::size_t layer, double z) {
  if (std::abs(near.dz) < std::min(tolerances_.slope_reach, near.reach)) {
    levels_.add_sloped(near.level, piece);
  }
  if (z > complex_.levels.front() && z < complex_.levels.back()) {
    levels_.add_slope(layer, piece);
  }
}

}  // namespace roomcut::weigh_faces
