// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/picture/depth_band.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roomcut {

using Eigen::Vector3d;

DepthBand::DepthBand(int width, int most_rows)
    : image_(width, most_rows),
      depth_(static_cast<std::size_t>(width) * static_cast<std::size_t>(most_rows)) {}

void DepthBand::begin(int first, int rows) {
  first_ = first;
  end_ = first + rows;
  image_.fill({255, 255, 255});
  std::fill(depth_.begin(), depth_.end(), -std::numeric_limits<float>::max());
}

void DepthBand::triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, Colour colour) {
  const double doubled_area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  if (std::abs(doubled_area) < 1e-9) {
    return;
  }
  const int y0 = std::max(first_, static_cast<int>(std::ceil(std::min({a.y(), b.y(), c.y()}))));
  const int y1 = std::min(end_ - 1, static_cast<int>(std::floor(std::max({a.y(), b.y(), c.y()}))));
  const int x0 = std::max(0, static_cast<int>(std::ceil(std::min({a.x(), b.x(), c.x()}))));
  const int x1 = std::min(image_.width() - 1, static_cast<int>(std::floor(std::max({a.x(), b.x(), c.x()}))));
  const double inverse = 1 / doubled_area;
  const auto weights = [&](int x, int y) {
    const double u = ((b.x() - x) * (c.y() - y) - (b.y() - y) * (c.x() - x)) * inverse;
    const double v = ((c.x() - x) * (a.y() - y) - (c.y() - y) * (a.x() - x)) * inverse;
    return std::array<double, 3>{u, v, 1 - u - v};
  };
  const auto inside = [&](int x, int y) {
    const auto [u, v, w] = weights(x, y);
    return u >= -1e-9 && v >= -1e-9 && w >= -1e-9;
  };
  const double z_per_x =
      ((b.y() - c.y()) * a.z() + (c.y() - a.y()) * b.z() + (a.y() - b.y()) * c.z()) * inverse;
  for (int y = y0; y <= y1; ++y) {
    auto [first, last] = inside_row({a, b, c}, y, x0, x1);
    while (first <= last && !inside(first, y)) {
      ++first;
    }
    while (first < last && !inside(last, y)) {
      --last;
    }
    if (first <= last) {
      const auto [u, v, w] = weights(first, y);
      fill_row(first, last, y, u * a.z() + v * b.z() + w * c.z(), z_per_x, colour);
    }
  }
}

void DepthBand::line(const Vector3d& a, const Vector3d& b, Colour colour) {
  const Vector3d way = b - a;
  const int steps = std::max(1, static_cast<int>(std::ceil(way.head<2>().cwiseAbs().maxCoeff())));
  int from = 0;
  int to = steps;
  if (std::abs(way.y()) > 1e-6) {  // only the steps that may lie in the band
    const double enter = (first_ - 1 - a.y()) / way.y() * steps;
    const double leave = (end_ - a.y()) / way.y() * steps;
    from = static_cast<int>(std::clamp(std::floor(std::min(enter, leave)), 0.0, static_cast<double>(steps)));
    to = static_cast<int>(std::clamp(std::ceil(std::max(enter, leave)), 0.0, static_cast<double>(steps)));
  }
  for (int i = from; i <= to; ++i) {
    const Vector3d p = a + way * (static_cast<double>(i) / steps);
    const int x = static_cast<int>(std::lround(p.x()));
    const int y = static_cast<int>(std::lround(p.y()));
    if (y >= first_ && y < end_) {
      fill_row(std::max(x, 0), std::min(x + 1, image_.width() - 1), y, p.z(), 0, colour);
    }
  }
}

void DepthBand::square(int x, int y, int size, double z, Colour colour) {
  const int x0 = std::max(x, 0);
  const int x1 = std::min(x + size, image_.width()) - 1;
  for (int at = std::max(y, first_); at < std::min(y + size, end_); ++at) {
    fill_row(x0, x1, at, z, 0, colour);
  }
}

/// The pixels [first, last] of a row, of a surface whose depth grows by z_per_x from one to the next.
void DepthBand::fill_row(int first, int last, int y, double z, double z_per_x, Colour colour) {
  float* const depth =
      depth_.data() + static_cast<std::size_t>(y - first_) * static_cast<std::size_t>(image_.width());
  Colour* const pixels = image_.row(y - first_);
  for (int x = first; x <= last; ++x) {
    // No running sum: that would wait for the last one.
    const auto here = static_cast<float>(z + z_per_x * (x - first));
    if (here > depth[x]) {
      depth[x] = here;
      pixels[x] = colour;
    }
  }
}

/// The columns of a row that may lie in a triangle, one more on each side, within [x0, x1].
std::pair<int, int> DepthBand::inside_row(const std::array<Vector3d, 3>& corners, int y, int x0, int x1) {
  double low = std::numeric_limits<double>::max();
  double high = -low;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& p = corners[k];
    const Vector3d& q = corners[(k + 1) % 3];
    if (std::min(p.y(), q.y()) > y + 1e-6 || std::max(p.y(), q.y()) < y - 1e-6) {
      continue;
    }
    const double rise = q.y() - p.y();
    const double t = std::abs(rise) > 1e-6 ? std::clamp((y - p.y()) / rise, 0.0, 1.0) : 0.0;
    const double x = p.x() + t * (q.x() - p.x());
    const double other = std::abs(rise) > 1e-6 ? x : q.x();
    low = std::min({low, x, other});
    high = std::max({high, x, other});
  }
  if (low > high) {
    return {x0, x0 - 1};
  }
  return {std::max(x0, static_cast<int>(std::floor(low)) - 1),
          std::min(x1, static_cast<int>(std::ceil(high)) + 1)};
}

}  // namespace roomcut
