// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "common/cloud/cloud.h"
#include "common/random/counter_random.h"
#include "stages/find_openings/find_openings.h"
#include "tests/unit/extract/grid_complex.h"

namespace roomcut::test {
using namespace roomcut::find_openings;

/// A rectangle in (y, z) on the wall.
struct Patch {
  double y0, y1, z0, z1;
  bool holds(double y, double z) const { return y > y0 && y < y1 && z > z0 && z < z1; }
};

/// Two rooms of 4 x 5 x 2.6 m with a wall from x = 4 to 4 + thickness between them, and the points of a scan
/// of that wall: its faces but for holes, and whatever else a test puts there. All turned by `angle`.
class MadeWall {
 public:
  double thickness = 0.12, noise_m = 0.005, density = 500, angle = 0;
  std::uint64_t seed = 1;

  /// The two faces, without points in the patches.
  void faces(const std::vector<Patch>& holes_a, const std::vector<Patch>& holes_b) {
    face(4, holes_a);
    face(4 + thickness, holes_b);
  }
  /// Points on an upright rectangle across the wall (a jamb) at y, from z0 to z1, over a part of the
  /// thickness.
  void jamb(double y, double z0, double z1, double from = 0, double to = 1) {
    fill(thickness * (to - from) * (z1 - z0),
         [&] { add(4 + thickness * uniform(from, to), y + normal(), uniform(z0, z1)); });
  }
  /// Points on a level rectangle inside the wall at z, from y0 to y1: a head or a threshold.
  void level(double z, double y0, double y1) {
    fill(thickness * (y1 - y0), [&] { add(4 + thickness * uniform(0, 1), uniform(y0, y1), z + normal()); });
  }
  /// Points on an upright rectangle along the wall at depth x - 4: a door leaf, a wardrobe's front.
  void panel(double depth, const Patch& at) {
    fill((at.y1 - at.y0) * (at.z1 - at.z0),
         [&] { add(4 + depth + normal(), uniform(at.y0, at.y1), uniform(at.z0, at.z1)); });
  }
  /// A whole doorway: holes are left to faces().
  void doorway(const Patch& door) {
    jamb(door.y0, door.z0, door.z1);
    jamb(door.y1, door.z0, door.z1);
    level(door.z1, door.y0, door.y1);
    level(door.z0, door.y0, door.y1);
  }

  /// The wall between these y is missing in the labels.
  Patch gap{0, 0, 0, 0};

  CellComplex complex() const {
    std::vector<double> y{-1, 0, 5, 6};
    if (gap.y1 > gap.y0) {
      y = {-1, 0, gap.y0, gap.y1, 5, 6};
    }
    return grid_complex({-1, 0, 4, 4 + thickness, 8, 9}, y, {-0.5, 0, 2.6, 3}, angle);
  }
  Labels labels(const CellComplex& made) const {
    return label_where(made, [&](const Vec2& p, double z) {
      const Vec2 q = turned(p, -angle);
      const bool in_a = q.x() > 0 && q.x() < 4;
      const bool in_b = q.x() > 4 + thickness && q.x() < 8;
      const bool in_gap = q.x() > 0 && q.x() < 8 && q.y() > gap.y0 && q.y() < gap.y1;
      return (in_a || in_b || in_gap) && q.y() > 0 && q.y() < 5 && z > 0 && z < 2.6;
    });
  }
  std::vector<Opening> search() const {
    const CellComplex made = complex();
    const FindOpeningsParams params;
    const OpeningTolerances tolerances = opening_tolerances(params, noise_m, density);
    const std::vector<RoomWall> walls =
        find_room_walls(made, labels(made).label, params.max_thickness_m, kWidestGap_m, kColumn_m);
    WallEvidence evidence(walls, made.levels, {tolerances.margin_m, tolerances.row_m});
    evidence.add(tile_);
    return find_openings::find_openings(made, walls, evidence, params, tolerances);
  }
  /// Position along the wall and back again.
  double y_of(const Vec2& p) const { return turned(p, -angle).y(); }
  CloudTile& tile() { return tile_; }

  void add(double x, double y, double z) {
    const Vec2 p = turned({x, y}, angle);
    tile_.x.push_back(static_cast<float>(p.x()));
    tile_.y.push_back(static_cast<float>(p.y()));
    tile_.z.push_back(static_cast<float>(z));
  }
  double uniform(double low, double high) { return low + (high - low) * random_unit(seed, 1, count_++); }
  double normal() {
    const double u = random_unit(seed, 2, count_++);
    const double v = random_unit(seed, 3, count_++);
    return noise_m * std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * std::numbers::pi * v);
  }

 private:
  static Vec2 turned(const Vec2& p, double by) {
    return {std::cos(by) * p.x() - std::sin(by) * p.y(), std::sin(by) * p.x() + std::cos(by) * p.y()};
  }
  void fill(double area, const std::function<void()>& one) const {
    for (int i = static_cast<int>(area * density); i > 0; --i) {
      one();
    }
  }
  void face(double x, const std::vector<Patch>& holes) {
    fill(5 * 2.6, [&] {
      const double y = uniform(0, 5);
      const double z = uniform(0, 2.6);
      for (const Patch& hole : holes) {
        if (hole.holds(y, z)) {
          return;
        }
      }
      add(x + normal(), y, z);
    });
  }

  CloudTile tile_;
  std::uint64_t count_ = 0;
};

}  // namespace roomcut::test
