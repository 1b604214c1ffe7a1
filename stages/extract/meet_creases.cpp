// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/meet_creases.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "stages/extract/columns.h"

namespace roomcut::extract {

namespace {

constexpr double kFarthest_m = 0.15;
constexpr double kParallel = 1e-3;  // two walls, or two planes: sine, difference of rise per metre

/// A vertex shall move by `by` along the unit vector `along`.
struct Pull {
  Vec2 along;
  double by;
};

/// What is asked of one vertex.
struct Demand {
  std::vector<Vec2> walls;  ///< normals of the walls through it
  std::vector<Pull> creases;
};

class CreaseMover {
 public:
  CreaseMover(const std::vector<std::uint8_t>& label, const LevelSurfaces& surfaces, CellComplex& complex)
      : label_(label), surfaces_(surfaces), complex_(complex), heights_(complex, surfaces) {}

  int move() {
    demands_.resize(complex_.vertices.size());
    const Storeys one{{}, std::vector<std::int16_t>(complex_.cells(), 0)};
    columns_ = columns_of(heights_, label_, one);
    bool any = false;
    for (const CellComplex::Edge& edge : complex_.edges) {
      any = demand_of_crease(edge) || any;
    }
    if (!any) {
      return 0;
    }
    for (const CellComplex::Edge& edge : complex_.edges) {
      demand_of_wall(edge);
    }
    const std::vector<Vec2> old = complex_.vertices;
    for (std::size_t v = 0; v < demands_.size(); ++v) {
      complex_.vertices[v] += displacement(demands_[v]);
    }
    take_back_what_turns_over(old);
    int moved = 0;
    for (std::size_t v = 0; v < old.size(); ++v) {
      moved += complex_.vertices[v] != old[v] ? 1 : 0;
    }
    return moved;
  }

 private:
  const Vec2& vertex(std::int32_t v) const { return complex_.vertices[static_cast<std::size_t>(v)]; }

  bool is_crease(const CellComplex::Edge& edge) const {
    if (edge.line < 0) {
      return false;
    }
    const CellComplex::Line& line = complex_.lines[static_cast<std::size_t>(edge.line)];
    return line.plane >= 0 && line.layers.empty();
  }

  /// Floors with floors and ceilings with ceilings over a crease, and beside nothing a floor with its
  /// ceiling.
  bool demand_of_crease(const CellComplex::Edge& edge) {
    if (!is_crease(edge)) {
      return false;
    }
    bool any = false;
    const auto runs = [&](std::int32_t face) {
      const auto f = static_cast<std::size_t>(face);
      return face < 0
                 ? std::span<const Run>()
                 : std::span(columns_.runs).subspan(columns_.first(f), columns_.last(f) - columns_.first(f));
    };
    for (const Run& left : runs(edge.left)) {
      for (const Run& right : runs(edge.right)) {
        any = demand(edge, left.lower, right.lower) || any;
        any = demand(edge, left.upper, right.upper) || any;
      }
    }
    for (const auto& [face, other] : {std::pair(edge.left, edge.right), std::pair(edge.right, edge.left)}) {
      for (const Run& run : runs(face)) {
        const auto beside = runs(other);
        if (std::none_of(beside.begin(), beside.end(), [&](const Run& o) {
              return o.lower.level <= run.upper.level && run.lower.level <= o.upper.level;
            })) {
          any = demand(edge, run.lower, run.upper) || any;
        }
      }
    }
    return any;
  }

  /// Both ends of an edge shall lie where two planes meet, if that is near.
  bool demand(const CellComplex::Edge& edge, const RunEnd& a, const RunEnd& b) {
    if ((a.surface == b.surface && (a.surface >= 0 || a.level == b.level)) ||
        (!heights_.is_sloped(a) && !heights_.is_sloped(b))) {
      return false;
    }
    const Vec2 difference = gradient(a) - gradient(b);
    const double steep = difference.norm();
    if (steep < kParallel) {
      return false;
    }
    const auto pull = [&](std::int32_t v) {
      return Pull{difference / steep, (heights_.z(b, vertex(v)) - heights_.z(a, vertex(v))) / steep};
    };
    const Pull at_v0 = pull(edge.v0);
    const Pull at_v1 = pull(edge.v1);
    if (std::max(std::abs(at_v0.by), std::abs(at_v1.by)) > kFarthest_m) {
      return false;
    }
    demands_[static_cast<std::size_t>(edge.v0)].creases.push_back(at_v0);
    demands_[static_cast<std::size_t>(edge.v1)].creases.push_back(at_v1);
    return true;
  }

  Vec2 gradient(const RunEnd& end) const {
    return end.surface < 0 ? Vec2(0, 0) : surfaces_.surfaces[static_cast<std::size_t>(end.surface)].gradient;
  }

  /// Vertices stay on an edge that carries a wall, and on the bounding box.
  void demand_of_wall(const CellComplex::Edge& edge) {
    const auto differs = [&] {
      for (std::size_t k = 0; k < complex_.layers(); ++k) {
        if (is_empty(complex_, label_, edge.left, k) != is_empty(complex_, label_, edge.right, k)) {
          return true;
        }
      }
      return false;
    };
    if (edge.line >= 0 && (complex_.lines[static_cast<std::size_t>(edge.line)].plane >= 0 || !differs())) {
      return;
    }
    const Vec2 along = (vertex(edge.v1) - vertex(edge.v0)).normalized();
    for (const std::int32_t v : {edge.v0, edge.v1}) {
      demands_[static_cast<std::size_t>(v)].walls.emplace_back(-along.y(), along.x());
    }
  }

  /// The shortest way to where all is fulfilled, or creases as well as can be.
  static Vec2 displacement(const Demand& demand) {
    if (demand.creases.empty()) {
      return {0, 0};
    }
    Eigen::Matrix2d free = Eigen::Matrix2d::Identity();  // projects onto where the walls let it go
    if (!demand.walls.empty()) {
      const Vec2& n = demand.walls.front();
      for (const Vec2& other : demand.walls) {
        if (std::abs(n.x() * other.y() - n.y() * other.x()) > kParallel) {
          return {0, 0};
        }
      }
      free -= n * n.transpose();
    }
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Vec2 right(0, 0);
    for (const Pull& pull : demand.creases) {
      const Vec2 along = free * pull.along;
      normal += along * along.transpose();
      right += along * pull.by;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solved(normal);
    Vec2 way(0, 0);
    for (int i = 0; i < 2; ++i) {
      constexpr double kWeak = 1e-3;  // creases that are nearly one: no way along them
      if (solved.eigenvalues()[i] > kWeak) {
        const Vec2 axis = solved.eigenvectors().col(i);
        way += axis * (axis.dot(right) / solved.eigenvalues()[i]);
      }
    }
    return way.norm() <= kFarthest_m ? Vec2(free * way) : Vec2(0, 0);
  }

  /// Every face must still be seen whole from its middle.
  void take_back_what_turns_over(const std::vector<Vec2>& old) {
    for (bool again = true; again;) {
      again = false;
      for (std::size_t face = 0; face < complex_.faces(); ++face) {
        if (is_star(complex_.corners(face), complex_.centroid(face))) {
          continue;
        }
        for (const std::int32_t v : complex_.vertices_of(face)) {
          again = again || vertex(v) != old[static_cast<std::size_t>(v)];
          complex_.vertices[static_cast<std::size_t>(v)] = old[static_cast<std::size_t>(v)];
        }
      }
    }
  }

  static bool is_star(const FaceCorners& corners, const Vec2& middle) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 a = corners[i] - middle;
      const Vec2 b = corners.after(i) - middle;
      if (a.x() * b.y() - a.y() * b.x() <= 0) {
        return false;
      }
    }
    return true;
  }

  const std::vector<std::uint8_t>& label_;
  const LevelSurfaces& surfaces_;
  CellComplex& complex_;
  EndHeights heights_;
  Columns columns_;
  std::vector<Demand> demands_;
};

}  // namespace

int meet_creases(const std::vector<std::uint8_t>& label, const LevelSurfaces& surfaces,
                 CellComplex& complex) {
  return surfaces.of_face.empty() ? 0 : CreaseMover(label, surfaces, complex).move();
}

}  // namespace roomcut::extract
