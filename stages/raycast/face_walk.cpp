// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/face_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roomcut::raycast {

namespace {
constexpr double kStill = 1e-12;  // a ray that moves less towards a face runs along it
}

double completed_share(double omega) {
  constexpr double kNothing = 0.05;  // stray points, rims
  constexpr double kWhole = 0.4;
  return std::clamp((omega - kNothing) / (kWhole - kNothing), 0.0, 1.0);
}

FaceWalk::FaceWalk(const CellComplex& complex, const FaceWeights& weights)
    : complex_(complex), weights_(weights) {
  const auto complete = [](float omega, float front, float back) {
    const double scale = omega > 0 ? completed_share(omega) / omega : 0;
    return Sides{static_cast<float>(scale * front), static_cast<float>(scale * back)};
  };
  for (std::size_t i = 0; i < weights.wall_omega.size(); ++i) {
    walls_.push_back(complete(weights.wall_omega[i], weights.wall_left[i], weights.wall_right[i]));
  }
  for (std::size_t i = 0; i < weights.level_omega.size(); ++i) {
    Sides sides = complete(weights.level_omega[i], weights.level_floor[i], weights.level_ceiling[i]);
    // A roof that passes through the cell below shuts it like a ceiling.
    const float slope = i < complex.faces() ? 0 : weights.cell_slope[i - complex.faces()];
    sides.back = std::max(sides.back, std::min(static_cast<float>(completed_share(slope)), 1 - sides.front));
    levels_.push_back(sides);
  }
  sides_.reserve(complex.face_vertex.size());
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    const FaceCorners corners = complex.corners(f);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2& a = corners[i];
      const Vec2 along = (corners.after(i) - a).normalized();
      const std::int32_t e = complex.edges_of(f)[i];
      const CellComplex::Edge& edge = complex.edges[static_cast<std::size_t>(e)];
      const bool is_left = edge.left == static_cast<std::int32_t>(f);
      const double nx = along.y();
      const double ny = -along.x();
      sides_.push_back({a.x(), a.y(), nx, ny, nx * a.x() + ny * a.y(), e,
                        edge.across(static_cast<std::int32_t>(f)), is_left});
    }
  }
}

/// Where the ray leaves the face sideways: by the side whose ends lie right and left of it. Corners in the
/// middle of a straight side make that exact where distances to the sides' lines are equal, and both faces at
/// an edge see its ends on the same sides.
inline FaceWalk::Exit FaceWalk::side_exit(const Ray& ray, std::size_t face) const {
  const auto begin = static_cast<std::size_t>(complex_.face_offset[face]);
  const auto end = static_cast<std::size_t>(complex_.face_offset[face + 1]);
  const double dx = ray.direction.x();
  const double dy = ray.direction.y();
  const auto is_left = [&](const Side& side) {
    return dx * (side.ay - ray.origin.y()) - dy * (side.ax - ray.origin.x()) > 0;
  };
  bool from_left = is_left(sides_[end - 1]);
  for (std::size_t i = begin; i < end; ++i) {
    const bool to_left = is_left(sides_[i]);
    if (!from_left && to_left) {
      const Side& side = sides_[i > begin ? i - 1 : end - 1];
      const double speed = side.nx * dx + side.ny * dy;
      return {&side, (side.d - side.nx * ray.origin.x() - side.ny * ray.origin.y()) / speed};
    }
    from_left = to_left;
  }
  return {};  // straight up or down
}

/// Where it leaves the layer; infinity for a level ray.
inline double FaceWalk::level_exit(const Ray& ray, std::size_t layer) const {
  const double dz = ray.direction.z();
  if (std::abs(dz) <= kStill) {
    return std::numeric_limits<double>::infinity();
  }
  return (complex_.levels[dz > 0 ? layer + 1 : layer] - ray.origin.z()) / dz;
}

inline Crossing FaceWalk::through_side(const Side& side, std::size_t face, std::size_t layer,
                                       double at) const {
  const std::size_t w = complex_.wall_face(static_cast<std::size_t>(side.edge), layer);
  const Sides& s = walls_[w];
  const std::size_t cell = complex_.cell(face, layer);
  return side.is_left ? Crossing{at, weights_.wall_omega[w], s.front, s.back, weights_.wall_left[w], cell}
                      : Crossing{at, weights_.wall_omega[w], s.back, s.front, weights_.wall_right[w], cell};
}

inline Crossing FaceWalk::through_level(bool up, std::size_t face, std::size_t layer, double at) const {
  const std::size_t l = complex_.level_face(face, up ? layer + 1 : layer);
  const Sides& s = levels_[l];
  const std::size_t cell = complex_.cell(face, layer);
  return up ? Crossing{at, weights_.level_omega[l], s.back, s.front, weights_.level_ceiling[l], cell}
            : Crossing{at, weights_.level_omega[l], s.front, s.back, weights_.level_floor[l], cell};
}

void FaceWalk::follow(const Ray& ray, std::vector<Crossing>& crossings, double limit_m, double opaque) const {
  crossings.clear();
  const bool up = ray.direction.z() > 0;
  std::size_t face = ray.face;
  std::size_t layer = ray.layer;
  double now = 0;
  double left = 1;  // of the ray
  double level_at = level_exit(ray, layer);
  // Every step crosses an edge or a level; rounding at a sliver may not send a ray around for ever.
  for (std::size_t step = 0; step < complex_.edges.size() + complex_.levels.size(); ++step) {
    const Exit exit = side_exit(ray, face);
    const double next = std::min(exit.at, level_at);
    if (next > limit_m || next == std::numeric_limits<double>::infinity()) {
      return;
    }
    now = std::max(now, next);
    if (exit.at <= level_at) {
      crossings.push_back(through_side(*exit.side, face, layer, now));
      if (exit.side->neighbour < 0) {
        return;
      }
      face = static_cast<std::size_t>(exit.side->neighbour);
    } else {
      crossings.push_back(through_level(up, face, layer, now));
      if (up ? layer + 1 == complex_.layers() : layer == 0) {
        return;
      }
      layer = up ? layer + 1 : layer - 1;
      level_at = level_exit(ray, layer);
    }
    left *= 1 - crossings.back().front - crossings.back().back;
    if (opaque > 0 && left < opaque) {
      return;
    }
  }
}

/// Which corner of the face lies farthest along a direction that no wall is likely to stand across: the same
/// one however the face's corners are numbered.
std::size_t FaceWalk::first_corner(std::size_t face) const {
  const Vec2 direction(0.8507, 0.5257);
  const FaceCorners corners = complex_.corners(face);
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    farthest = direction.dot(corners[farthest]) < direction.dot(corners[i]) ? i : farthest;
  }
  return farthest;
}

Vec2 FaceWalk::point_in(std::size_t face, double u, double v) const {
  const FaceCorners corners = complex_.corners(face);
  const std::size_t first = first_corner(face);
  const auto corner = [&](std::size_t i) -> const Vec2& { return corners[(first + i) % corners.size()]; };
  const Vec2& a = corner(0);
  const auto twice_area = [&](std::size_t i) {
    const Vec2 b = corner(i) - a;
    const Vec2 c = corner(i + 1) - a;
    return b.x() * c.y() - b.y() * c.x();
  };
  double total = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    total += twice_area(i);
  }
  double rest = u * total;
  std::size_t i = 1;
  double here = twice_area(i);
  for (; i + 2 < corners.size() && rest >= here; here = twice_area(++i)) {
    rest -= here;
  }
  // The rest of u is again uniform; folding (s, t) at the diagonal makes the triangle uniform.
  double s = here > 0 ? std::clamp(rest / here, 0.0, 1.0) : 0.5;
  double t = v;
  if (s + t > 1) {
    s = 1 - s;
    t = 1 - t;
  }
  return a + s * (corner(i) - a) + t * (corner(i + 1) - a);
}

}  // namespace roomcut::raycast
