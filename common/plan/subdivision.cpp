// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/plan/subdivision.h"

#include <utility>

namespace roomcut {

Subdivision::Subdivision(const Vec2& low, const Vec2& high)
    : vertices{low, {high.x(), low.y()}, high, {low.x(), high.y()}},
      face_start{0},
      original{0},
      root_{~0},
      slot_{~0},
      low_(low),
      high_(high) {
  for (std::int32_t i = 0; i < 4; ++i) {
    const std::int32_t after = (i + 1) % 4;
    const std::int32_t before = (i + 3) % 4;
    half_edges.push_back({i, 2 * after, 2 * before, 0, kNoLine});
    half_edges.push_back({after, 2 * before + 1, 2 * after + 1, kOutside, kNoLine});
  }
}

Subdivision::Subdivision(std::vector<Vec2> old_vertices, std::vector<HalfEdge> old_half_edges,
                         std::vector<std::int32_t> old_face_start)
    : vertices(std::move(old_vertices)),
      half_edges(std::move(old_half_edges)),
      face_start(std::move(old_face_start)),
      low_(vertices.front()),
      high_(vertices.front()) {
  for (const Vec2& p : vertices) {
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
  for (std::int32_t face = 0; face < static_cast<std::int32_t>(face_start.size()); ++face) {
    root_.push_back(~face);
    original.push_back(face);
    slot_.push_back(~face);
  }
}

std::int32_t Subdivision::split_edge(std::int32_t h, const Vec2& p) {
  const std::int32_t t = twin(h);
  const auto vertex = static_cast<std::int32_t>(vertices.size());
  const auto ahead = static_cast<std::int32_t>(half_edges.size());  // new vertex -> old target
  const std::int32_t back = ahead + 1;                              // old target -> new vertex
  vertices.push_back(p);
  half_edges.push_back({vertex, half_edges[h].next, h, half_edges[h].face, half_edges[h].line});
  half_edges.push_back({half_edges[t].origin, t, half_edges[t].prev, half_edges[t].face, half_edges[t].line});
  half_edges[half_edges[h].next].prev = ahead;
  half_edges[h].next = ahead;
  half_edges[half_edges[t].prev].next = back;
  half_edges[t].prev = back;
  half_edges[t].origin = vertex;
  return ahead;
}

void Subdivision::split_face(std::int32_t h, std::int32_t g, std::int32_t line, const Line2& geometry) {
  const std::int32_t face = half_edges[h].face;
  const auto fresh = static_cast<std::int32_t>(face_start.size());
  const auto closing =
      static_cast<std::int32_t>(half_edges.size());  // origin(g) -> origin(h): closes h's part
  const std::int32_t before_h = half_edges[h].prev;
  const std::int32_t before_g = half_edges[g].prev;
  half_edges.push_back({half_edges[g].origin, h, before_g, face, line});
  half_edges.push_back({half_edges[h].origin, g, before_h, face, line});
  half_edges[before_g].next = closing;
  half_edges[h].prev = closing;
  half_edges[before_h].next = closing + 1;
  half_edges[g].prev = closing + 1;

  // The part with fewer corners becomes the new face: renaming stays cheap beside long sides.
  std::int32_t a = h;
  std::int32_t b = g;
  do {
    a = half_edges[a].next;
    b = half_edges[b].next;
  } while (a != h && b != g);
  const bool fresh_is_below = a == h;
  const std::int32_t start = fresh_is_below ? h : g;
  std::int32_t walk = start;
  do {
    half_edges[walk].face = fresh;
    walk = half_edges[walk].next;
  } while (walk != start);
  face_start.push_back(start);
  original.push_back(original[face]);
  face_start[face] = fresh_is_below ? g : h;

  const auto split = static_cast<std::int32_t>(splits_.size());
  node(slot_[face]) = split;
  splits_.push_back(
      {geometry.normal(), geometry.d, ~(fresh_is_below ? fresh : face), ~(fresh_is_below ? face : fresh)});
  slot_.push_back(2 * split + (fresh_is_below ? 0 : 1));
  slot_[face] = 2 * split + (fresh_is_below ? 1 : 0);
}

void Subdivision::link(std::int32_t before, std::int32_t after) {
  half_edges[before].next = after;
  half_edges[after].prev = before;
}

void Subdivision::remove_edge(std::int32_t h) {
  const std::int32_t t = twin(h);
  const std::int32_t kept = half_edges[h].face;
  const std::int32_t gone = half_edges[t].face;
  for (std::int32_t walk = half_edges[t].next; walk != t; walk = half_edges[walk].next) {
    half_edges[walk].face = kept;
  }
  const std::int32_t into_origin = half_edges[h].prev;
  const std::int32_t into_target = half_edges[t].prev;
  link(into_origin, half_edges[t].next);
  link(into_target, half_edges[h].next);
  face_start[kept] = into_origin;
  face_start[gone] = kRemoved;
  half_edges[h].face = half_edges[t].face = kRemoved;
  dissolve_end(into_origin);
  dissolve_end(into_target);
}

/// Where h and the half-edge after it are the only edges at a vertex and on one line, h takes over the other
/// one's part.
void Subdivision::dissolve_end(std::int32_t h) {
  const std::int32_t ahead = half_edges[h].next;
  const std::int32_t t = twin(h);
  const std::int32_t back = twin(ahead);
  const Vec2& p = from(ahead);
  const bool corner_of_rectangle =
      (p.x() == low_.x() || p.x() == high_.x()) && (p.y() == low_.y() || p.y() == high_.y());
  if (half_edges[back].next != t || half_edges[h].line != half_edges[ahead].line || corner_of_rectangle) {
    return;
  }
  const std::int32_t face = half_edges[h].face;
  const std::int32_t beyond = half_edges[t].face;
  half_edges[t].origin = half_edges[back].origin;
  link(h, half_edges[ahead].next);
  link(half_edges[back].prev, t);
  if (face != kOutside) {
    face_start[face] = h;
  }
  if (beyond != kOutside) {
    face_start[beyond] = t;
  }
  half_edges[ahead].face = half_edges[back].face = kRemoved;
}

/// What stands at a place of the trees.
std::int32_t& Subdivision::node(std::int32_t slot) {
  if (slot < 0) {
    return root_[~slot];
  }
  Split& split = splits_[slot / 2];
  return slot % 2 == 0 ? split.below : split.above;
}

std::int32_t Subdivision::locate(const Vec2& p, std::int32_t within) const {
  std::int32_t at = root_[within];
  while (at >= 0) {
    const Split& split = splits_[at];
    at = split.normal.dot(p) - split.d < 0 ? split.below : split.above;
  }
  return ~at;
}

std::vector<std::int32_t> Subdivision::faces_in_tree_order() const {
  std::vector<std::int32_t> order;
  order.reserve(face_start.size());
  std::vector<std::int32_t> open(root_.rbegin(), root_.rend());
  while (!open.empty()) {
    const std::int32_t at = open.back();
    open.pop_back();
    if (at < 0) {
      if (face_start[~at] != kRemoved) {
        order.push_back(~at);
      }
    } else {
      open.push_back(splits_[at].above);
      open.push_back(splits_[at].below);
    }
  }
  return order;
}

}  // namespace roomcut
