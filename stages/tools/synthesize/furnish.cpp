// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/random/counter_random.h"
#include "stages/tools/synthesize/building.h"
#include "stages/tools/synthesize/plan.h"
#include "stages/tools/synthesize/room_heights.h"

namespace roomcut::synthesize {

namespace {

constexpr std::uint64_t kStream = 0x6675726e;  // of the random numbers
constexpr int kAttempts = 40;                  // per box
constexpr double kLowest = 0.3;                // under a slope [m]
constexpr double kDoorClearance = 1.0;         // from a doorway's middle to a box's corner or centre [m]

struct Kind {
  double width_lo, width_hi, depth_lo, depth_hi, height_lo, height_hi, share;
  bool at_wall;
};
// Tables and desks, cupboards, shelves, low boards, boxes and chairs: sizes in metres as sold.
constexpr Kind kKinds[] = {{1.2, 2.0, 0.7, 0.9, 0.70, 0.76, 0.25, false},
                           {0.8, 1.6, 0.40, 0.6, 1.80, 2.10, 0.20, true},
                           {0.8, 1.2, 0.28, 0.4, 1.20, 2.00, 0.20, true},
                           {1.0, 1.8, 0.40, 0.5, 0.50, 0.90, 0.15, true},
                           {0.4, 0.6, 0.40, 0.6, 0.40, 0.90, 0.20, false}};

std::vector<Vec2> corners(const SceneFurniture& box) {
  const Vec2 x = box.size_x / 2 * Vec2(std::cos(box.rotation), std::sin(box.rotation));
  const Vec2 y = box.size_y / 2 * Vec2(-std::sin(box.rotation), std::cos(box.rotation));
  return {box.centre - x - y, box.centre + x - y, box.centre + x + y, box.centre - x + y};
}

class Furnisher {
 public:
  Furnisher(const Scene& scene, Building& building) : scene_(scene), building_(building) {}

  void furnish_room(std::size_t r) {
    room_ = &scene_.rooms[r];
    counter_ = r << 32;
    first_ = building_.furniture.size();
    const double area = doubled_area(room_->polygon) / 2;
    const int boxes = static_cast<int>(area * scene_.clutter_per_m2 + draw());
    for (int i = 0; i < boxes; ++i) {
      for (int attempt = 0; attempt < kAttempts; ++attempt) {
        const SceneFurniture box = propose();
        if (fits(box, r)) {
          building_.furniture.push_back(box);
          break;
        }
      }
    }
  }

 private:
  double draw() { return random_unit(scene_.seed, kStream, counter_++); }
  double draw(double lo, double hi) { return lo + (hi - lo) * draw(); }

  SceneFurniture propose() {
    double pick = draw();
    const Kind* kind = kKinds;
    while (pick > kind->share && kind + 1 != std::end(kKinds)) pick -= (kind++)->share;
    SceneFurniture box;
    box.size_x = draw(kind->width_lo, kind->width_hi);
    box.size_y = draw(kind->depth_lo, kind->depth_hi);
    const double height = draw(kind->height_lo, kind->height_hi);
    const std::size_t side = static_cast<std::size_t>(draw() * static_cast<double>(room_->polygon.size()));
    const Vec2& a = room_->polygon[side];
    const Vec2 ab = room_->polygon[(side + 1) % room_->polygon.size()] - a;
    const Vec2 inwards = Vec2(-ab.y(), ab.x()).normalized();
    box.rotation = std::atan2(ab.y(), ab.x());
    if (kind->at_wall) {
      box.centre = a + draw() * ab + (draw(0.01, 0.03) + box.size_y / 2) * inwards;
    } else {
      box.centre = a + draw() * ab + draw(0.5, 6.0) * inwards;
      if (draw() < 0.3) box.rotation = draw(0, std::numbers::pi);
    }
    stand(box, height);
    return box;
  }

  /// On the highest floor under it, and not through the ceiling.
  void stand(SceneFurniture& box, double height) const {
    double floor = room_->floor;
    double ceiling = room_->ceiling;
    for (const Vec2& p : corners(box)) {
      floor = std::max(floor, floor_at(*room_, p));
      ceiling = std::min(ceiling, ceiling_at(*room_, p));
    }
    box.z0 = floor;
    box.z1 = floor + std::min(height, ceiling - floor - 0.1);
  }

  bool fits(const SceneFurniture& box, std::size_t room) const {
    const std::vector<Vec2> outline = corners(box);
    if (borders_cross(outline, room_->polygon) || box.z1 < box.z0 + kLowest) return false;
    for (const SceneColumn& column : room_->columns) {
      if (borders_cross(outline, column.polygon) || contains(outline, column.centre)) return false;
    }
    for (const Vec2& p : outline) {
      if (!contains(room_->polygon, p)) return false;
    }
    for (std::size_t i = first_; i < building_.furniture.size(); ++i) {
      const std::vector<Vec2> other = corners(building_.furniture[i]);
      if (borders_cross(outline, other) || contains(outline, building_.furniture[i].centre) ||
          contains(other, box.centre)) {
        return false;
      }
    }
    return clear_of_openings(box, room);
  }

  bool clear_of_openings(const SceneFurniture& box, std::size_t room) const {
    for (const WallOpening& door : building_.doors) {
      const bool here = door.room_a == static_cast<int>(room) || door.room_b == static_cast<int>(room);
      if (here && in_plan(box, door.centre, kDoorClearance)) return false;
    }
    for (const Prism& prism : building_.prisms) {  // the foot of a stairwell stays free
      if (!prism.is_room() && in_plan(box, polygon_centroid(prism.polygon), kDoorClearance)) return false;
    }
    return true;
  }

  const Scene& scene_;
  Building& building_;
  const SceneRoom* room_ = nullptr;
  std::uint64_t counter_ = 0;
  std::size_t first_ = 0;
};

}  // namespace

void furnish(const Scene& scene, Building& building) {
  Furnisher furnisher(scene, building);
  for (std::size_t r = 0; r < scene.rooms.size(); ++r) furnisher.furnish_room(r);
}

}  // namespace roomcut::synthesize
