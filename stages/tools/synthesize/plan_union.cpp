// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/plan_union.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "common/errors/codes.h"
#include "stages/tools/synthesize/plan.h"
#include "stages/tools/synthesize/plan_graph.h"
#include "stages/tools/synthesize/plan_triangulation.h"
#include "stages/tools/synthesize/room_heights.h"
#include "stages/tools/synthesize/scene_limits.h"

namespace roomcut::synthesize {

namespace {

constexpr double kTolerance = 1e-6;  // corners of the plan that are closer are one [m]
constexpr double kStraight = 1e-9;   // a corner that is off a straight wall by less is dropped [m]

/// Whether b lies on the line from a to c.
bool is_straight(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 along = c - a;
  const Vec2 off = b - a;
  return std::abs(along.x() * off.y() - along.y() * off.x()) < kStraight * along.norm() && along.dot(off) > 0;
}

class Uniter {
 public:
  Uniter(const Scene& scene, const Building& building, std::vector<Problem>& problems)
      : scene_(scene), building_(building), problems_(problems) {}
  PlanUnion unite();

 private:
  using Owner =
      std::int32_t;  // room that fills a layer of a piece; kPassage = doorway or shaft; kUnset = nothing
  static constexpr Owner kPassage = -2;
  struct Piece {
    std::vector<Owner> owner;           // per layer
    std::vector<std::int32_t> surface;  // per height
    std::int32_t region = 0;
  };

  void collect_heights();
  void collect_slopes();
  std::vector<Polygon2> plans() const;
  Piece solid_piece() const;
  bool is_solid(int room, const Vec2& p) const;
  void lay_slopes(const Prism& prism, const Vec2& p, Piece& piece) const;
  std::int32_t region_of(const Piece& piece);
  bool cross_between(const PlanUnion::Edge& edge, std::int32_t from, std::int32_t to) const;
  void overlay();
  Piece piece_at(const Vec2& p);
  void check_piece(const std::vector<std::int32_t>& prisms, const Piece& piece);
  void check_touching(const Piece& a, const Piece& b);
  void collect_edges();
  void straighten();
  void triangulate();
  std::size_t layer_of(double z) const {
    return static_cast<std::size_t>(std::lower_bound(result_.heights.begin(), result_.heights.end(), z) -
                                    result_.heights.begin());
  }
  const std::string& name(Owner room) const { return scene_.rooms[static_cast<std::size_t>(room)].name; }
  void problem(const std::string& what, const std::string& hint);

  const Scene& scene_;
  const Building& building_;
  std::vector<Problem>& problems_;
  std::set<std::string> said_;
  PlanUnion result_;
  Cdt cdt_;
  std::vector<Piece> pieces_;
  std::map<std::pair<std::vector<char>, std::vector<std::int32_t>>, std::int32_t> region_of_;
  std::vector<std::int32_t> first_slope_;  // per room
};

PlanUnion Uniter::unite() {
  collect_heights();
  collect_slopes();
  overlay();
  if (!problems_.empty()) return result_;
  collect_edges();
  straighten();
  triangulate();
  return result_;
}

void Uniter::problem(const std::string& what, const std::string& hint) {
  if (said_.insert(what).second)
    problems_.push_back({errors::kSceneInvalid, scene_.name, what, hint.empty() ? kSceneRemedy : hint});
}

void Uniter::collect_heights() {
  for (const Prism& prism : building_.prisms) {
    result_.heights.push_back(prism.z0);
    result_.heights.push_back(prism.z1);
  }
  std::sort(result_.heights.begin(), result_.heights.end());
  result_.heights.erase(std::unique(result_.heights.begin(), result_.heights.end()), result_.heights.end());
  const double layers = static_cast<double>(result_.heights.size() * building_.prisms.size());
  if (layers > scene_limits::kLayers) {
    throw StageError(errors::kSceneInvalid, scene_.name,
                     std::to_string(result_.heights.size()) + " different heights of " +
                         std::to_string(building_.prisms.size()) + " rooms and openings are too many",
                     "give the rooms of a storey the same floor and ceiling");
  }
}

void Uniter::collect_slopes() {
  for (const SceneRoom& room : scene_.rooms) {
    first_slope_.push_back(static_cast<std::int32_t>(result_.heights.size() + result_.slopes.size()));
    for (const SceneSlope& slope : room.slopes) result_.slopes.push_back({slope.gradient, slope.c});
  }
}

/// What cuts the plan: prisms, solids, and where floors and ceilings of a room begin or meet.
std::vector<Polygon2> Uniter::plans() const {
  std::vector<Polygon2> plans;
  for (const Prism& prism : building_.prisms) plans.push_back(prism.polygon);
  for (const Solid& solid : building_.solids) plans.push_back(solid.polygon);
  for (const SceneRoom& room : scene_.rooms) {
    if (room.slopes.empty()) continue;
    for (const SceneSlope& slope : room.slopes) {
      if (!slope.polygon.empty()) plans.push_back(slope.polygon);
    }
    for (const auto& [a, b] : creases(room)) plans.push_back({a, b});
  }
  return plans;
}

/// The overlay of all plans; every triangle gets the index of its piece.
void Uniter::overlay() {
  const PlanGraph graph = cut_at_crossings(plans(), kTolerance);
  result_.vertices = graph.vertices;
  std::vector<Cdt::Vertex_handle> handle;
  for (const Vec2& p : graph.vertices) {
    handle.push_back(cdt_.insert({p.x(), p.y()}));
    handle.back()->info() = static_cast<std::int32_t>(handle.size()) - 1;
  }
  for (const auto& segment : graph.segments) cdt_.insert_constraint(handle[segment[0]], handle[segment[1]]);
  for (auto face : cdt_.all_face_handles()) face->info() = kUnset;
  pieces_.push_back(solid_piece());
  region_of(pieces_.back());  // the first one
  flood(cdt_, cdt_.infinite_face(), 0);
  for (auto face : cdt_.finite_face_handles()) {
    if (face->info() != kUnset) continue;
    const Cdt::Face_handle inner = flood(cdt_, face, static_cast<std::int32_t>(pieces_.size()));
    Vec2 sum(0, 0);
    for (int i = 0; i < 3; ++i) sum += result_.vertices[inner->vertex(i)->info()];
    pieces_.push_back(piece_at(sum / 3));
  }
}

Uniter::Piece Uniter::piece_at(const Vec2& p) {
  std::vector<std::int32_t> inside;
  for (std::size_t i = 0; i < building_.prisms.size(); ++i) {
    if (contains(building_.prisms[i].polygon, p)) inside.push_back(static_cast<std::int32_t>(i));
  }
  Piece piece = solid_piece();
  for (const std::int32_t i : inside) {
    const Prism& prism = building_.prisms[i];
    if (prism.is_room() && is_solid(prism.room_a, p)) continue;
    if (prism.is_room()) lay_slopes(prism, p, piece);
    for (std::size_t k = layer_of(prism.z0); k < layer_of(prism.z1); ++k) {
      Owner& owner = piece.owner[k];
      if (prism.is_room() && owner >= 0) {
        problem("rooms \"" + name(owner) + "\" and \"" + name(prism.room_a) + "\" overlap",
                "leave a wall or a slab between them");
      }
      if (prism.is_room() || owner == kUnset) owner = prism.is_room() ? prism.room_a : kPassage;
    }
  }
  check_piece(inside, piece);
  piece.region = region_of(piece);
  return piece;
}

Uniter::Piece Uniter::solid_piece() const {
  Piece piece{std::vector<Owner>(result_.heights.size() - 1, kUnset), {}, 0};
  piece.surface.resize(result_.heights.size());
  std::iota(piece.surface.begin(), piece.surface.end(), 0);
  return piece;
}

/// Whether p is where the room is none: in a column, or where its roof has come down to its floor.
bool Uniter::is_solid(int room, const Vec2& p) const {
  const SceneRoom& at = scene_.rooms[static_cast<std::size_t>(room)];
  return floor_at(at, p) >= ceiling_at(at, p) ||
         std::any_of(building_.solids.begin(), building_.solids.end(),
                     [&](const Solid& solid) { return solid.room == room && contains(solid.polygon, p); });
}

/// Puts the room's slopes over p in the place of its highest and lowest level.
void Uniter::lay_slopes(const Prism& prism, const Vec2& p, Piece& piece) const {
  const SceneRoom& room = scene_.rooms[static_cast<std::size_t>(prism.room_a)];
  const std::int32_t first = first_slope_[static_cast<std::size_t>(prism.room_a)];
  const int lower = surface_at(room, p, false);
  const int upper = surface_at(room, p, true);
  if (lower >= 0) piece.surface[layer_of(prism.z0)] = first + lower;
  if (upper >= 0) piece.surface[layer_of(prism.z1)] = first + upper;
}

/// The region of pieces that are empty in the same layers, between the same surfaces.
std::int32_t Uniter::region_of(const Piece& piece) {
  std::vector<char> empty;
  for (const Owner owner : piece.owner) empty.push_back(owner == kUnset ? 0 : 1);
  std::vector<std::int32_t> surface = piece.surface;
  for (std::size_t l = 0; l < surface.size(); ++l) {
    const bool below = l > 0 && empty[l - 1] != 0;
    const bool above = l < empty.size() && empty[l] != 0;
    if (below == above) surface[l] = static_cast<std::int32_t>(l);
  }
  const auto [found, is_new] =
      region_of_.emplace(std::pair{empty, surface}, static_cast<std::int32_t>(result_.empty.size()));
  if (is_new) {
    result_.empty.push_back(std::move(empty));
    result_.surface.push_back(std::move(surface));
  }
  return found->second;
}

void Uniter::check_piece(const std::vector<std::int32_t>& prisms, const Piece& piece) {
  for (const std::int32_t i : prisms) {
    const Prism& prism = building_.prisms[i];
    for (std::size_t k = layer_of(prism.z0); k < layer_of(prism.z1) && !prism.is_room(); ++k) {
      const Owner owner = piece.owner[k];
      if (owner >= 0 && owner != prism.room_a && owner != prism.room_b) {
        problem("the passage between \"" + name(prism.room_a) + "\" and \"" + name(prism.room_b) +
                    "\" reaches into room \"" + name(owner) + "\"",
                "move it, or make it narrower");
      }
    }
  }
  for (std::size_t k = 0; k + 1 < piece.owner.size(); ++k) {
    if (piece.owner[k] >= 0 && piece.owner[k + 1] >= 0 && piece.owner[k] != piece.owner[k + 1]) {
      problem("rooms \"" + name(piece.owner[k]) + "\" and \"" + name(piece.owner[k + 1]) +
                  "\" touch without a slab",
              "leave a slab between them");
    }
  }
}

void Uniter::check_touching(const Piece& a, const Piece& b) {
  for (std::size_t k = 0; k < a.owner.size(); ++k) {
    if (a.owner[k] >= 0 && b.owner[k] >= 0 && a.owner[k] != b.owner[k]) {
      problem("rooms \"" + name(std::min(a.owner[k], b.owner[k])) + "\" and \"" +
                  name(std::max(a.owner[k], b.owner[k])) + "\" touch without a wall",
              "leave a wall between them, or make them one room");
    }
  }
}

/// The borders between different regions.
void Uniter::collect_edges() {
  for (auto edge = cdt_.finite_edges_begin(); edge != cdt_.finite_edges_end(); ++edge) {
    if (!cdt_.is_constrained(*edge)) continue;
    const auto [face, i] = *edge;
    const Piece& left = pieces_[face->info()];
    const Piece& right = pieces_[face->neighbor(i)->info()];
    check_touching(left, right);
    if (left.region == right.region) continue;
    PlanUnion::Edge border{face->vertex(Cdt::ccw(i))->info(), face->vertex(Cdt::cw(i))->info(), left.region,
                           right.region};
    if (border.v0 > border.v1) border = {border.v1, border.v0, border.right, border.left};
    result_.edges.push_back(border);
  }
  // CGAL visits edges in the order of addresses in memory.
  std::sort(result_.edges.begin(), result_.edges.end(),
            [](const auto& a, const auto& b) { return std::pair(a.v0, a.v1) < std::pair(b.v0, b.v1); });
}

/// Whether two surfaces of the regions beside an edge cross between two of its places.
bool Uniter::cross_between(const PlanUnion::Edge& edge, std::int32_t from, std::int32_t to) const {
  std::vector<std::int32_t> surfaces;
  for (const std::int32_t region : {edge.left, edge.right}) {
    for (std::size_t l = 0; l < result_.heights.size(); ++l) {
      if (result_.changes(region, l)) surfaces.push_back(result_.surface[region][l]);
    }
  }
  const auto difference = [&](std::int32_t a, std::int32_t b, std::int32_t v) {
    return result_.height(a, result_.vertices[v]) - result_.height(b, result_.vertices[v]);
  };
  for (const std::int32_t a : surfaces) {
    for (const std::int32_t b : surfaces) {
      if (difference(a, b, from) > PlanUnion::kSame && difference(a, b, to) < -PlanUnion::kSame) return true;
    }
  }
  return false;
}

/// Joins edges that go on straight between the same two regions.
void Uniter::straighten() {
  std::vector<std::vector<std::size_t>> at(result_.vertices.size());
  for (std::size_t e = 0; e < result_.edges.size(); ++e) {
    at[result_.edges[e].v0].push_back(e);
    at[result_.edges[e].v1].push_back(e);
  }
  std::vector<char> dropped(result_.edges.size(), 0);
  for (std::size_t v = 0; v < at.size(); ++v) {
    if (at[v].size() != 2) continue;
    const std::size_t e0 = at[v][0];
    const std::size_t e1 = at[v][1];
    PlanUnion::Edge& a = result_.edges[e0];
    PlanUnion::Edge b = result_.edges[e1];
    if ((a.v1 == static_cast<std::int32_t>(v)) != (b.v0 == static_cast<std::int32_t>(v))) {
      std::swap(b.v0, b.v1);
      std::swap(b.left, b.right);
    }
    const bool a_first = a.v1 == static_cast<std::int32_t>(v);
    const std::int32_t from = a_first ? a.v0 : b.v0;
    const std::int32_t to = a_first ? b.v1 : a.v1;
    if (a.left != b.left || a.right != b.right || from == to ||
        !is_straight(result_.vertices[from], result_.vertices[v], result_.vertices[to]) ||
        cross_between(a, from, to)) {
      continue;
    }
    a.v0 = from;
    a.v1 = to;
    dropped[e1] = 1;
    std::replace(at[a_first ? to : from].begin(), at[a_first ? to : from].end(), e1, e0);
  }
  std::size_t kept = 0;
  for (std::size_t e = 0; e < result_.edges.size(); ++e) {
    if (dropped[e] == 0) result_.edges[kept++] = result_.edges[e];
  }
  result_.edges.resize(kept);
}

void Uniter::triangulate() {
  std::vector<std::int32_t> number(result_.vertices.size(), kUnset);
  std::vector<Vec2> used;
  std::vector<Cdt::Vertex_handle> handle;
  Cdt cdt;
  const auto insert = [&](std::int32_t& v) {
    if (number[v] == kUnset) {
      number[v] = static_cast<std::int32_t>(used.size());
      used.push_back(result_.vertices[v]);
      handle.push_back(cdt.insert({used.back().x(), used.back().y()}));
      handle.back()->info() = number[v];
    }
    v = number[v];
  };
  for (PlanUnion::Edge& edge : result_.edges) {
    insert(edge.v0);
    insert(edge.v1);
  }
  result_.vertices = used;
  for (const PlanUnion::Edge& edge : result_.edges) cdt.insert_constraint(handle[edge.v0], handle[edge.v1]);
  for (auto face : cdt.all_face_handles()) face->info() = kUnset;
  for (const PlanUnion::Edge& edge : result_.edges) {
    Cdt::Face_handle face;
    int i = 0;
    if (!cdt.is_edge(handle[edge.v0], handle[edge.v1], face, i)) {
      problem("corners of the plan lie too close together", "keep corners 1 mm apart");
      return;
    }
    const bool face_is_left = face->vertex(Cdt::ccw(i)) == handle[edge.v0];
    const auto opposite = face->neighbor(i);
    if (face->info() == kUnset) flood(cdt, face, face_is_left ? edge.left : edge.right);
    if (opposite->info() == kUnset) flood(cdt, opposite, face_is_left ? edge.right : edge.left);
  }
  for (auto face : cdt.finite_face_handles()) {
    std::array<std::int32_t, 3> corners{face->vertex(0)->info(), face->vertex(1)->info(),
                                        face->vertex(2)->info()};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result_.triangles.push_back(corners);
    result_.triangle_region.push_back(face->info());
  }
}

}  // namespace

PlanUnion unite(const Scene& scene, const Building& building, std::vector<Problem>& problems) {
  return Uniter(scene, building, problems).unite();
}

}  // namespace roomcut::synthesize
