// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/plan_cutter.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace roomcut::extract {

namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

PlanCutter::PlanCutter(const CellComplex& complex) : complex_(complex), loops_(complex.faces()) {
  for (std::size_t f = 0; f < loops_.size(); ++f) {
    parent_.push_back(static_cast<std::int32_t>(f));
    const auto vertices = complex.vertices_of(f);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      loops_[f].push_back({vertices[i], complex.edges_of(f)[i]});
    }
  }
}

std::int32_t PlanCutter::locate(const Vec2& p) const {
  for (std::size_t f = 0; f < loops_.size(); ++f) {
    const auto& loop = loops_[f];
    bool inside = true;
    for (std::size_t i = 0; inside && i < loop.size(); ++i) {
      const Vec2& a = complex_.vertices[static_cast<std::size_t>(loop[i].vertex)];
      const Vec2& b = complex_.vertices[static_cast<std::size_t>(loop[(i + 1) % loop.size()].vertex)];
      inside = cross(b - a, p - a) >= 0;
    }
    if (inside) {
      return static_cast<std::int32_t>(f);
    }
  }
  return -1;
}

void PlanCutter::cut(const Line2& line, double t0, double t1, const std::string& id) {
  const auto index = static_cast<std::int32_t>(complex_.lines.size());
  complex_.lines.push_back({id, line, t0, t1, {}});
  std::vector<std::int32_t> open{locate(line.at(0.5 * (t0 + t1)))};
  std::vector<std::int32_t> seen;
  while (!open.empty()) {
    const std::int32_t face = open.back();
    open.pop_back();
    if (face < 0 || std::find(seen.begin(), seen.end(), face) != seen.end()) {
      continue;
    }
    seen.push_back(face);
    const Chord chord = chord_of(face, line);
    if (chord.from < 0) {
      continue;
    }
    if (worth_a_split(face, chord)) {
      split_face(face, chord, index);
      seen.push_back(static_cast<std::int32_t>(loops_.size()) - 1);
    }
    for (const std::int32_t vertex : {chord.from, chord.to}) {
      const double t = line.along(complex_.vertices[static_cast<std::size_t>(vertex)]);
      if (t > t0 + kPlanSnap_m && t < t1 - kPlanSnap_m) {
        const std::vector<std::int32_t> next = faces_at(vertex);
        open.insert(open.end(), next.begin(), next.end());
      }
    }
  }
}

std::vector<std::int32_t> PlanCutter::faces_at(std::int32_t vertex) const {
  std::vector<std::int32_t> faces;
  for (const CellComplex::Edge& edge : complex_.edges) {
    if (edge.v0 == vertex || edge.v1 == vertex) {
      faces.push_back(edge.left);
      faces.push_back(edge.right);
    }
  }
  return faces;
}

/// Where the line crosses the face's border: corners on it, or new ones. None when the face lies on one side.
PlanCutter::Chord PlanCutter::chord_of(std::int32_t face, const Line2& line) {
  const auto side = [&](std::int32_t vertex) {
    const double d = line.distance(complex_.vertices[static_cast<std::size_t>(vertex)]);
    return d > kPlanSnap_m ? 1 : d < -kPlanSnap_m ? -1 : 0;
  };
  const std::vector<Corner> loop = loops_[static_cast<std::size_t>(face)];  // split_edge changes the original
  const std::size_t size = loop.size();
  std::vector<std::int32_t> crossings;
  bool above = false;
  bool below = false;
  for (std::size_t i = 0; i < size; ++i) {
    above = above || side(loop[i].vertex) > 0;
    below = below || side(loop[i].vertex) < 0;
  }
  if (!above || !below) {
    return {};
  }
  for (std::size_t i = 0; i < size; ++i) {
    const std::int32_t v = loop[i].vertex;
    const std::int32_t w = loop[(i + 1) % size].vertex;
    if (side(v) == 0) {
      crossings.push_back(v);
    } else if (side(v) * side(w) < 0) {
      const Vec2 p = complex_.vertices[static_cast<std::size_t>(v)];
      const Vec2 q = complex_.vertices[static_cast<std::size_t>(w)];
      const double s = line.distance(p) / (line.distance(p) - line.distance(q));
      crossings.push_back(split_edge(loop[i].edge, p + s * (q - p)));
    }
  }
  // A straight side may have several corners within the tolerance: the outermost two make the chord.
  const auto by_t = [&](std::int32_t a, std::int32_t b) {
    return line.along(complex_.vertices[static_cast<std::size_t>(a)]) <
           line.along(complex_.vertices[static_cast<std::size_t>(b)]);
  };
  const auto [low, high] = std::minmax_element(crossings.begin(), crossings.end(), by_t);
  return *low == *high ? Chord{} : Chord{*low, *high};
}

std::int32_t PlanCutter::split_edge(std::int32_t e, const Vec2& p) {
  const auto vertex = static_cast<std::int32_t>(complex_.vertices.size());
  complex_.vertices.push_back(p);
  const CellComplex::Edge old = complex_.edges[static_cast<std::size_t>(e)];
  const auto fresh = static_cast<std::int32_t>(complex_.edges.size());
  complex_.edges.push_back({vertex, old.v1, old.left, old.right, old.line});
  complex_.edges[static_cast<std::size_t>(e)].v1 = vertex;
  for (const std::int32_t face : {old.left, old.right}) {
    if (face < 0) {
      continue;
    }
    auto& loop = loops_[static_cast<std::size_t>(face)];
    const auto at = std::find_if(loop.begin(), loop.end(), [&](const Corner& c) { return c.edge == e; });
    if (at->vertex == old.v0) {
      loop.insert(at + 1, {vertex, fresh});
    } else {
      at->edge = fresh;
      loop.insert(at + 1, {vertex, e});
    }
  }
  return vertex;
}

bool PlanCutter::worth_a_split(std::int32_t face, const Chord& chord) const {
  const Vec2& from = complex_.vertices[static_cast<std::size_t>(chord.from)];
  const Vec2 along = complex_.vertices[static_cast<std::size_t>(chord.to)] - from;
  double left = 0;
  double right = 0;
  for (const Corner& corner : loops_[static_cast<std::size_t>(face)]) {
    const double off =
        cross(along, complex_.vertices[static_cast<std::size_t>(corner.vertex)] - from) / along.norm();
    left = std::max(left, off);
    right = std::min(right, off);
  }
  return along.norm() > kPlanSnap_m && left > 0.5 * kPlanSnap_m && right < -0.5 * kPlanSnap_m;
}

void PlanCutter::split_face(std::int32_t face, const Chord& chord, std::int32_t line) {
  const auto fresh = static_cast<std::int32_t>(loops_.size());
  std::vector<Corner> loop = loops_[static_cast<std::size_t>(face)];
  std::rotate(loop.begin(),
              std::find_if(loop.begin(), loop.end(), [&](const Corner& c) { return c.vertex == chord.from; }),
              loop.end());
  const auto to =
      std::find_if(loop.begin(), loop.end(), [&](const Corner& c) { return c.vertex == chord.to; });
  const auto edge = static_cast<std::int32_t>(complex_.edges.size());
  std::vector<Corner> first(loop.begin(), to);  // from … to, closed by the chord back: on the chord's right
  first.push_back({chord.to, edge});
  std::vector<Corner> second(to, loop.end());  // to … from, closed by the chord forth: on its left
  second.push_back({chord.from, edge});
  complex_.edges.push_back({chord.from, chord.to, fresh, face, line});
  for (auto i = to; i != loop.end(); ++i) {
    CellComplex::Edge& moved = complex_.edges[static_cast<std::size_t>(i->edge)];
    (moved.left == face ? moved.left : moved.right) = fresh;
  }
  loops_[static_cast<std::size_t>(face)] = std::move(first);
  loops_.push_back(std::move(second));
  parent_.push_back(parent_[static_cast<std::size_t>(face)]);
}

CellComplex PlanCutter::result(std::vector<std::int32_t>& parent) const {
  CellComplex complex = complex_;
  complex.face_offset.assign(1, 0);
  complex.face_vertex.clear();
  complex.face_edge.clear();
  for (const auto& loop : loops_) {
    for (const Corner& corner : loop) {
      complex.face_vertex.push_back(corner.vertex);
      complex.face_edge.push_back(corner.edge);
    }
    complex.face_offset.push_back(static_cast<std::int64_t>(complex.face_vertex.size()));
  }
  parent = parent_;
  return complex;
}

}  // namespace roomcut::extract
