// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/face_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roomcut::evaluate {

namespace {

constexpr double kOnEdge = 1e-9;  // twice the area of point and edge [m^2]: rounding, nothing more

double turn(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
}

}  // namespace

FaceLocator::FaceLocator(const CellComplex& complex) : complex_(complex) {
  lo_ = hi_ = complex.vertices.front();
  for (const Vec2& p : complex.vertices) {
    lo_ = lo_.cwiseMin(p);
    hi_ = hi_.cwiseMax(p);
  }
  const Vec2 size = hi_ - lo_;
  cell_ = std::max(0.1, std::sqrt(size.x() * size.y() / static_cast<double>(complex.faces())));
  nx_ = static_cast<std::int64_t>(size.x() / cell_) + 1;
  ny_ = static_cast<std::int64_t>(size.y() / cell_) + 1;
  faces_in_.resize(static_cast<std::size_t>(nx_ * ny_));
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    Vec2 lo = complex.vertices[static_cast<std::size_t>(complex.face_vertex[complex.face_offset[f]])];
    Vec2 hi = lo;
    for (std::int64_t i = complex.face_offset[f]; i < complex.face_offset[f + 1]; ++i) {
      const Vec2& p = complex.vertices[static_cast<std::size_t>(complex.face_vertex[i])];
      lo = lo.cwiseMin(p);
      hi = hi.cwiseMax(p);
    }
    const std::size_t first = bucket(lo.x(), lo.y());
    const std::size_t last = bucket(hi.x(), hi.y());
    const auto width = static_cast<std::size_t>(nx_);
    for (std::size_t y = first / width; y <= last / width; ++y) {
      for (std::size_t x = first % width; x <= last % width; ++x) {
        faces_in_[y * width + x].push_back(static_cast<std::int32_t>(f));
      }
    }
  }
}

std::size_t FaceLocator::bucket(double x, double y) const {
  const auto index = [&](double value, std::int64_t count) {
    return std::clamp(static_cast<std::int64_t>(value / cell_), std::int64_t{0}, count - 1);
  };
  return static_cast<std::size_t>(index(y - lo_.y(), ny_) * nx_ + index(x - lo_.x(), nx_));
}

bool FaceLocator::contains(std::int32_t face, const Vec2& p) const {
  const auto f = static_cast<std::size_t>(face);
  const std::int64_t first = complex_.face_offset[f];
  const std::int64_t count = complex_.face_offset[f + 1] - first;
  for (std::int64_t i = 0; i < count; ++i) {
    const auto a = static_cast<std::size_t>(complex_.face_vertex[first + i]);
    const auto b = static_cast<std::size_t>(complex_.face_vertex[first + (i + 1) % count]);
    if (turn(complex_.vertices[a], complex_.vertices[b], p) < -kOnEdge) {
      return false;
    }
  }
  return true;
}

std::int32_t FaceLocator::face_at(double x, double y) const {
  if (x < lo_.x() || y < lo_.y() || x > hi_.x() || y > hi_.y()) {
    return -1;
  }
  const Vec2 p(x, y);
  const auto& candidates = faces_in_[bucket(x, y)];
  const auto found =
      std::find_if(candidates.begin(), candidates.end(), [&](std::int32_t f) { return contains(f, p); });
  return found == candidates.end() ? -1 : *found;
}

double distance_to_lines(const CellComplex& complex, std::int32_t face, const Vec2& p) {
  const auto f = static_cast<std::size_t>(face);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::int64_t i = complex.face_offset[f]; i < complex.face_offset[f + 1]; ++i) {
    const CellComplex::Edge& edge = complex.edges[static_cast<std::size_t>(complex.face_edge[i])];
    if (edge.line < 0) {
      continue;
    }
    const Vec2& a = complex.vertices[static_cast<std::size_t>(edge.v0)];
    const Vec2 along = complex.vertices[static_cast<std::size_t>(edge.v1)] - a;
    const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - a - t * along).norm());
  }
  return nearest;
}

}  // namespace roomcut::evaluate
