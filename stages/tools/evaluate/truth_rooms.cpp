// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/truth_rooms.h"

#include <algorithm>

namespace roomcut::evaluate {

bool in_polygon(const std::vector<Vec2>& polygon, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 &a = polygon[i], &b = polygon[j];
    if ((a.y() > y) != (b.y() > y) && x < (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  }
  return inside;
}

std::vector<TruthRoom> locate_rooms(const std::vector<DescribedRoom>& described, const Columns& truth) {
  std::vector<TruthRoom> rooms;
  std::vector<std::int32_t> room_of_body(static_cast<std::size_t>(truth.components()), -1);
  bool prisms = false;
  for (const DescribedRoom& d : described) {
    if (!d.polygon.empty()) {
      rooms.push_back({d.name, d.polygon, d.floor, d.ceiling, -1, d.scanned});
      prisms = true;
      continue;
    }
    const std::int32_t body = truth.component_at(d.inside);
    if (body < 0) {
      continue;
    }
    auto& known = room_of_body[static_cast<std::size_t>(body)];
    if (known >= 0) {
      TruthRoom& room = rooms[static_cast<std::size_t>(known)];
      room.name += " + " + d.name;
      room.scanned = room.scanned || d.scanned;
    } else {
      known = static_cast<std::int32_t>(rooms.size());
      rooms.push_back({d.name, {}, d.floor, d.ceiling, body, d.scanned});
    }
  }
  for (std::int32_t body = 0; body < truth.components() && !prisms; ++body) {
    if (room_of_body[static_cast<std::size_t>(body)] < 0) {
      rooms.push_back({"body " + std::to_string(body), {}, 0, 0, body, true});
    }
  }
  return rooms;
}

RoomFinder::RoomFinder(const std::vector<TruthRoom>& rooms, const Columns& truth)
    : rooms_(rooms), truth_(truth), room_of_body_(static_cast<std::size_t>(truth.components()), -1) {
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    Box box{{1, 1}, {-1, -1}};  // holds nothing
    if (rooms[i].body >= 0) {
      room_of_body_[static_cast<std::size_t>(rooms[i].body)] = static_cast<std::int32_t>(i);
    } else {
      box = {rooms[i].polygon.front(), rooms[i].polygon.front()};
      for (const Vec2& p : rooms[i].polygon) {
        box.lo = box.lo.cwiseMin(p);
        box.hi = box.hi.cwiseMax(p);
      }
    }
    boxes_.push_back(box);
  }
}

void RoomFinder::prisms_at(double x, double y, std::vector<std::int32_t>& out) const {
  out.clear();
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    const Box& box = boxes_[i];
    if (x >= box.lo.x() && x <= box.hi.x() && y >= box.lo.y() && y <= box.hi.y() &&
        in_polygon(rooms_[i].polygon, x, y)) {
      out.push_back(static_cast<std::int32_t>(i));
    }
  }
}

std::int32_t RoomFinder::at_surface(const Vec3& p, std::int32_t triangle, const Vec3& normal) const {
  const std::int32_t by_body = of_body(truth_.component_of(triangle));
  if (by_body >= 0) {
    return by_body;
  }
  constexpr double kStepBack = 1e-3;  // into the room
  const Vec3 q = p - kStepBack * normal;
  std::vector<std::int32_t> candidates;
  prisms_at(q.x(), q.y(), candidates);
  const auto found = std::find_if(candidates.begin(), candidates.end(), [&](std::int32_t i) {
    const TruthRoom& room = rooms_[static_cast<std::size_t>(i)];
    return q.z() > room.floor && q.z() < room.ceiling;
  });
  return found == candidates.end() ? -1 : *found;
}

}  // namespace roomcut::evaluate
