// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stages/tools/evaluate/columns.h"

namespace roomcut::evaluate {

/// A room as a truth.json describes it.
struct DescribedRoom {
  std::string name;
  std::vector<Vec2> polygon;  ///< its plan, with floor and ceiling; empty when only a point inside is known
  double floor = 0, ceiling = 0;
  Vec3 inside{0, 0, 0};
  bool scanned = true;  ///< a scanner stood in it
};

/// A room of the truth: an upright prism, or a body (component) of the truth mesh.
struct TruthRoom {
  std::string name;
  std::vector<Vec2> polygon;  ///< prism; empty for a body
  double floor = 0, ceiling = 0;
  std::int32_t body = -1;
  bool scanned = true;
};

/// Rooms with a polygon are taken as they are. Rooms without one are the bodies around their points: rooms in
/// one body become one, which is scanned when one of them is. Bodies that no room speaks for, and all bodies
/// when nothing is described, become rooms of their own, unless rooms have polygons.
std::vector<TruthRoom> locate_rooms(const std::vector<DescribedRoom>& described, const Columns& truth);

/// Tells which room a place is in.
class RoomFinder {
 public:
  RoomFinder(const std::vector<TruthRoom>& rooms, const Columns& truth);
  /// The room that a place on the truth's surface belongs to: `p` on `triangle`, `normal` out of the room; -1
  /// = none (a doorway).
  std::int32_t at_surface(const Vec3& p, std::int32_t triangle, const Vec3& normal) const;
  /// The rooms whose plan (x, y) may lie in: prisms only.
  void prisms_at(double x, double y, std::vector<std::int32_t>& out) const;
  /// Whether a scanner stood in a room.
  bool scanned(std::int32_t room) const { return rooms_[static_cast<std::size_t>(room)].scanned; }
  /// The room of a body; -1 = none.
  std::int32_t of_body(std::int32_t body) const { return room_of_body_[static_cast<std::size_t>(body)]; }

 private:
  struct Box {
    Vec2 lo, hi;
  };
  const std::vector<TruthRoom>& rooms_;
  const Columns& truth_;
  std::vector<Box> boxes_;
  std::vector<std::int32_t> room_of_body_;
};

/// Whether (x, y) lies in a polygon (even-odd).
bool in_polygon(const std::vector<Vec2>& polygon, double x, double y);

}  // namespace roomcut::evaluate
