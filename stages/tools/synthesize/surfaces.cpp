// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/surfaces.h"

#include <algorithm>
#include <cmath>

#include "stages/tools/synthesize/plan.h"
#include "stages/tools/synthesize/room_heights.h"

namespace roomcut::synthesize {

namespace {

constexpr double kBehind = 0.04;   // a surface this close behind furniture is not seen [m]
constexpr double kOnPlane = 1e-4;  // [m]
constexpr double kCell = 1.0;      // of the plan indices [m]

Vec3 lift(const Vec2& p, double z) {
  return {p.x(), p.y(), z};
}

}  // namespace

PlanIndex::PlanIndex(const Vec2& lo, const Vec2& hi, double edge)
    : lo_(lo),
      edge_(edge),
      nx_(static_cast<int>((hi.x() - lo.x()) / edge) + 1),
      ny_(static_cast<int>((hi.y() - lo.y()) / edge) + 1),
      cells_(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_)) {}

int PlanIndex::cell(double x, int axis) const {
  return static_cast<int>(std::floor((x - lo_[axis]) / edge_));
}

void PlanIndex::add(std::int32_t item, const Vec2& lo, const Vec2& hi) {
  for (int y = std::max(0, cell(lo.y(), 1)); y <= std::min(ny_ - 1, cell(hi.y(), 1)); ++y) {
    for (int x = std::max(0, cell(lo.x(), 0)); x <= std::min(nx_ - 1, cell(hi.x(), 0)); ++x) {
      cells_[static_cast<std::size_t>(y) * nx_ + x].push_back(item);
    }
  }
}

const std::vector<std::int32_t>& PlanIndex::at(const Vec2& p) const {
  static const std::vector<std::int32_t> kNone;
  const int x = cell(p.x(), 0);
  const int y = cell(p.y(), 1);
  if (x < 0 || y < 0 || x >= nx_ || y >= ny_) return kNone;
  return cells_[static_cast<std::size_t>(y) * nx_ + x];
}

TriangleMesh triangle_mesh(const std::vector<SurfaceTriangle>& triangles) {
  TriangleMesh mesh;
  for (const SurfaceTriangle& t : triangles) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {t.a, t.a + t.u, t.a + t.v});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

Surfaces::Surfaces(const Scene& scene, const Building& building, const TriangleMesh& truth)
    : building_(building) {
  for (const auto& t : truth.triangles) {
    const Vec3& a = truth.vertices[t[0]];
    triangles_.push_back({a, truth.vertices[t[1]] - a, truth.vertices[t[2]] - a, PointOrigin::kTruth});
  }
  const Vec2 lo = building.lo.head<2>() - Vec2::Constant(kCell);
  const Vec2 hi = building.hi.head<2>() + Vec2::Constant(kCell);
  furniture_ = PlanIndex(lo, hi, kCell);
  windows_ = PlanIndex(lo, hi, kCell);
  for (std::size_t i = 0; i < building.furniture.size(); ++i) {
    const SceneFurniture& box = building.furniture[i];
    const Vec2 reach = Vec2::Constant(0.5 * std::hypot(box.size_x, box.size_y) + kBehind);
    furniture_.add(static_cast<std::int32_t>(i), box.centre - reach, box.centre + reach);
  }
  for (std::size_t i = 0; i < building.windows.size(); ++i) {
    const WallOpening& window = building.windows[i];
    const Vec2 reach = Vec2::Constant(window.width / 2 + kOnPlane);
    windows_.add(static_cast<std::int32_t>(i), window.centre - reach, window.centre + reach);
  }
  add_furniture(scene);
  add_reveals();
}

void Surfaces::add_parallelogram(const Vec3& corner, const Vec3& u, const Vec3& v, PointOrigin kind) {
  triangles_.push_back({corner, u, v, kind});
  triangles_.push_back({corner + u + v, -u, -v, kind});
}

bool Surfaces::in_room(const Scene& scene, const Vec3& p) const {
  return std::any_of(scene.rooms.begin(), scene.rooms.end(), [&](const SceneRoom& room) {
    const Vec2 place = p.head<2>();
    return p.z() > room.floor && p.z() < room.ceiling && contains(room.polygon, place) &&
           p.z() > floor_at(room, place) && p.z() < ceiling_at(room, place);
  });
}

/// The faces of the boxes that can be seen: not those against a wall, on the floor, or against another box.
void Surfaces::add_furniture(const Scene& scene) {
  for (const SceneFurniture& box : building_.furniture) {
    const Vec2 ex(std::cos(box.rotation), std::sin(box.rotation));
    const Vec2 ey(-ex.y(), ex.x());
    const Vec3 x = lift(ex, 0) * box.size_x;
    const Vec3 y = lift(ey, 0) * box.size_y;
    const Vec3 z(0, 0, box.z1 - box.z0);
    const Vec3 corner = lift(box.centre, box.z0) - x / 2 - y / 2;
    const auto add_if_seen = [&](const Vec3& from, const Vec3& u, const Vec3& v, const Vec3& outwards) {
      const Vec3 before = from + u / 2 + v / 2 + outwards.normalized() * (1.5 * kBehind);
      if (in_room(scene, before) && !hidden(before, PointOrigin::kReveal)) {
        add_parallelogram(from, u, v, PointOrigin::kFurniture);
      }
    };
    add_if_seen(corner, x, z, -y);
    add_if_seen(corner + y, x, z, y);
    add_if_seen(corner, y, z, -x);
    add_if_seen(corner + x, y, z, x);
    add_if_seen(corner + z, x, y, z);
    add_if_seen(corner, x, y, -z);
  }
}

void Surfaces::add_reveals() {
  for (const WallOpening& window : building_.windows) {
    if (window.depth <= 0) continue;
    const Vec3 along = lift(window.right * window.width, 0);
    const Vec3 up(0, 0, window.z1 - window.z0);
    const Vec3 in = lift(window.outwards * window.depth, 0);
    const Vec3 corner = lift(window.centre, window.z0) - along / 2;
    add_parallelogram(corner, along, in, PointOrigin::kReveal);
    add_parallelogram(corner + up, along, in, PointOrigin::kReveal);
    add_parallelogram(corner, up, in, PointOrigin::kReveal);
    add_parallelogram(corner + along, up, in, PointOrigin::kReveal);
  }
}

bool Surfaces::hidden(const Vec3& p, PointOrigin kind) const {
  const double margin = kind == PointOrigin::kFurniture ? -kOnPlane : kBehind;
  const auto& near = furniture_.at(p.head<2>());
  return std::any_of(near.begin(), near.end(), [&](std::int32_t i) {
    const SceneFurniture& box = building_.furniture[i];
    return p.z() > box.z0 - margin && p.z() < box.z1 - kOnPlane && in_plan(box, p.head<2>(), margin);
  });
}

const WallOpening* Surfaces::window_at(const Vec3& p) const {
  for (const std::int32_t i : windows_.at(p.head<2>())) {
    const WallOpening& window = building_.windows[i];
    const Vec2 d = p.head<2>() - window.centre;
    if (p.z() > window.z0 && p.z() < window.z1 && std::abs(d.dot(window.outwards)) < kOnPlane &&
        std::abs(d.dot(window.right)) < window.width / 2) {
      return &window;
    }
  }
  return nullptr;
}

}  // namespace roomcut::synthesize
