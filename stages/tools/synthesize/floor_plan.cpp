// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/floor_plan.h"

#include <algorithm>
#include <cmath>

namespace roomcut::synthesize {

namespace {

constexpr double kNarrowest = 2.2;       // [m]
constexpr double kShortestSide = 0.8;    // [m]
constexpr double kShortestChord = 0.15;  // [m]
constexpr double kChordTurn = 0.5;       // a smaller turn between sides is an arc's [rad]
constexpr double kSharpestTurn = 2.53;   // corners of 35 degrees [rad]
constexpr double kOnLine = 1e-6;         // [m]

/// The part of the lot on the left of the line.
Lot left_part(const Lot& lot, const Vec2& through, const Vec2& direction, double wall) {
  const Vec2 normal(-direction.y(), direction.x());
  const std::size_t n = lot.corners.size();
  Lot part;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2& a = lot.corners[i];
    const Vec2& b = lot.corners[(i + 1) % n];
    const double da = (a - through).dot(normal);
    const double db = (b - through).dot(normal);
    if (da >= 0) {
      part.corners.push_back(a);
      part.wall.push_back(lot.wall[i]);
    }
    if ((da >= 0) == (db >= 0)) continue;
    part.corners.push_back(a + da / (da - db) * (b - a));
    part.wall.push_back(da >= 0 ? wall : lot.wall[i]);  // leaving: the new wall begins here
  }
  return part;
}

}  // namespace

std::pair<Lot, Lot> split_lot(const Lot& lot, const Vec2& through, const Vec2& direction, double wall) {
  return {left_part(lot, through, -direction, wall), left_part(lot, through, direction, wall)};
}

double extent(const Lot& lot, const Vec2& direction) {
  double lo = lot.corners[0].dot(direction);
  double hi = lo;
  for (const Vec2& p : lot.corners) {
    lo = std::min(lo, p.dot(direction));
    hi = std::max(hi, p.dot(direction));
  }
  return hi - lo;
}

bool is_room(const Lot& lot) {
  const std::size_t n = lot.corners.size();
  if (n < 3) return false;
  const auto side = [&](std::size_t i) -> Vec2 { return lot.corners[(i + 1) % n] - lot.corners[i % n]; };
  const auto turn = [&](std::size_t i) {  // between side i and the next one
    return std::acos(std::clamp(side(i).normalized().dot(side(i + 1).normalized()), -1.0, 1.0));
  };
  for (std::size_t i = 0; i < n; ++i) {
    const bool chord = turn(i) < kChordTurn || turn(i + n - 1) < kChordTurn;
    if (turn(i) > kSharpestTurn || side(i).norm() < (chord ? kShortestChord : kShortestSide)) return false;
    if (extent(lot, Vec2(-side(i).y(), side(i).x()).normalized()) < kNarrowest) return false;
  }
  return true;
}

std::vector<Contact> find_contacts(const std::vector<Lot>& lots, double shortest) {
  std::vector<Contact> contacts;
  const auto compare = [&](std::size_t la, std::size_t lb, std::size_t i, std::size_t j) {
    const Lot& a = lots[la];
    const Lot& b = lots[lb];
    const Vec2& p = a.corners[i];
    const Vec2 u = (a.corners[(i + 1) % a.corners.size()] - p).normalized();
    const double length = (a.corners[(i + 1) % a.corners.size()] - p).norm();
    const Vec2 q0 = b.corners[j] - p;
    const Vec2 q1 = b.corners[(j + 1) % b.corners.size()] - p;
    const Vec2 normal(-u.y(), u.x());
    if (std::abs(q0.dot(normal)) > kOnLine || std::abs(q1.dot(normal)) > kOnLine) return;
    const double from = std::max(0.0, q1.dot(u));
    const double to = std::min(length, q0.dot(u));
    if (to - from >= shortest) contacts.push_back({la, lb, p + from * u, p + to * u});
  };
  for (std::size_t la = 0; la < lots.size(); ++la) {
    for (std::size_t lb = la + 1; lb < lots.size(); ++lb) {
      for (std::size_t i = 0; i < lots[la].corners.size(); ++i) {
        for (std::size_t j = 0; j < lots[lb].corners.size(); ++j) compare(la, lb, i, j);
      }
    }
  }
  return contacts;
}

std::vector<Vec2> turned(const std::vector<Vec2>& points, double angle) {
  std::vector<Vec2> result;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  for (const Vec2& p : points) result.emplace_back(c * p.x() - s * p.y(), s * p.x() + c * p.y());
  return result;
}

}  // namespace roomcut::synthesize
