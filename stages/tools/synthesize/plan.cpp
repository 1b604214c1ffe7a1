// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/plan.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace roomcut::synthesize {

namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double side_of(const Vec2& a, const Vec2& b, const Vec2& p) {
  return cross(b - a, p - a);
}

bool segments_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0;
}

double segment_distance(const Vec2& a, const Vec2& b, const Vec2& p) {
  const Vec2 ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - (a + t * ab)).norm();
}

}  // namespace

double doubled_area(const Polygon2& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    sum += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  }
  return sum;
}

Vec2 polygon_centroid(const Polygon2& polygon) {
  Vec2 sum(0, 0);
  double weight = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const double w = side_of(polygon[0], polygon[i], polygon[i + 1]);
    sum += w * (polygon[0] + polygon[i] + polygon[i + 1]) / 3;
    weight += w;
  }
  return sum / weight;
}

bool contains(const Polygon2& polygon, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  }
  return inside;
}

double border_distance(const Polygon2& polygon, const Vec2& p) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    best = std::min(best, segment_distance(polygon[i], polygon[(i + 1) % polygon.size()], p));
  }
  return best;
}

bool borders_cross(const Polygon2& a, const Polygon2& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (segments_cross(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()])) return true;
    }
  }
  return false;
}

bool self_intersects(const Polygon2& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (segments_cross(polygon[i], polygon[(i + 1) % n], polygon[j], polygon[(j + 1) % n])) return true;
    }
    for (std::size_t j = 0; j < n; ++j) {  // a corner on a side that does not own it
      if (j != i && j != (i + 1) % n &&
          segment_distance(polygon[i], polygon[(i + 1) % n], polygon[j]) < 1e-9) {
        return true;
      }
    }
  }
  return false;
}

Vec2 innermost_point(const Polygon2& polygon) {
  Vec2 lo = polygon[0];
  Vec2 hi = polygon[0];
  for (const Vec2& p : polygon) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  constexpr int kSteps = 24;
  Vec2 best = polygon_centroid(polygon);
  double best_distance = contains(polygon, best) ? border_distance(polygon, best) : -1;
  for (int round = 0; round < 4; ++round) {
    const Vec2 from = lo;
    const Vec2 step = (hi - lo) / kSteps;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        const Vec2 p = from + Vec2(step.x() * i, step.y() * j);
        const double distance = contains(polygon, p) ? border_distance(polygon, p) : -1;
        if (distance > best_distance + 1e-9) {
          best_distance = distance;
          best = p;
        }
      }
    }
    lo = best - step;
    hi = best + step;
  }
  return best;
}

std::size_t nearest_side(const Polygon2& polygon, const Vec2& p) {
  std::size_t best = 0;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const double distance = segment_distance(polygon[i], polygon[(i + 1) % polygon.size()], p);
    if (distance < best_distance) {
      best_distance = distance;
      best = i;
    }
  }
  return best;
}

Polygon2 inset(const Polygon2& outline, const std::vector<double>& distance) {
  const std::size_t n = outline.size();
  Polygon2 result(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    const Vec2 u = (outline[i] - outline[before]).normalized();
    const Vec2 v = (outline[(i + 1) % n] - outline[i]).normalized();
    const Vec2 normal_u(-u.y(), u.x());
    const Vec2 normal_v(-v.y(), v.x());
    if (std::abs(cross(u, v)) < 1e-9) {
      if (u.dot(v) < 0 || std::abs(distance[before] - distance[i]) > 1e-12) {
        throw std::invalid_argument("neighbouring collinear sides need the same wall thickness");
      }
      result[i] = outline[i] + distance[i] * normal_v;
      continue;
    }
    Eigen::Matrix2d a;
    a << normal_u.x(), normal_u.y(), normal_v.x(), normal_v.y();
    const Vec2 b(normal_u.dot(outline[i]) + distance[before], normal_v.dot(outline[i]) + distance[i]);
    result[i] = a.inverse() * b;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if ((result[(i + 1) % n] - result[i]).dot(outline[(i + 1) % n] - outline[i]) <= 0) {
      throw std::invalid_argument("the walls are thicker than a side of the room is long");
    }
  }
  return result;
}

std::vector<Vec2> arc_points(const Vec2& a, const Vec2& b, const Vec2& c, int segments) {
  const double d = 2 * cross(b - a, c - a);
  if (std::abs(d) < 1e-9) throw std::invalid_argument("the three points of an arc lie on one line");
  const Vec2 ab = b - a;
  const Vec2 ac = c - a;
  const Vec2 centre = a + Vec2(ac.y() * ab.squaredNorm() - ab.y() * ac.squaredNorm(),
                               ab.x() * ac.squaredNorm() - ac.x() * ab.squaredNorm()) /
                              d;
  const double radius = (a - centre).norm();
  const double from = std::atan2(a.y() - centre.y(), a.x() - centre.x());
  double turn = std::atan2(c.y() - centre.y(), c.x() - centre.x()) - from;
  if (d > 0 && turn < 0) turn += 2 * std::numbers::pi;  // a, b, c turn left
  if (d < 0 && turn > 0) turn -= 2 * std::numbers::pi;
  std::vector<Vec2> points;
  for (int i = 1; i < segments; ++i) {
    const double angle = from + turn * i / segments;
    points.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  points.push_back(c);
  return points;
}

}  // namespace roomcut::synthesize
