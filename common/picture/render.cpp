// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/picture/render.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace roomcut {

namespace {

using Eigen::Vector3d;

/// Screen coordinates: x right, y down [pixels], z towards the eye [m].
class Projection {
 public:
  Projection(const Drawing& drawing, const View& view, int width, int height) {
    const Vector3d eye(std::cos(view.elevation) * std::cos(view.azimuth),
                       std::cos(view.elevation) * std::sin(view.azimuth), std::sin(view.elevation));
    const Vector3d right(-std::sin(view.azimuth), std::cos(view.azimuth), 0);
    axes_.row(0) = right;
    axes_.row(1) = -eye.cross(right);  // up on the screen is down in y
    axes_.row(2) = eye;
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::max());
    Vector3d high = -low;
    const auto extend = [&](const std::vector<Vector3d>& points) {
      for (const Vector3d& p : points) {
        const Vector3d q = axes_ * p;
        low = low.cwiseMin(q);
        high = high.cwiseMax(q);
      }
    };
    extend(drawing.vertices);
    extend(drawing.points);
    if (low.x() > high.x()) {
      return;
    }
    const Vector3d size = (high - low).cwiseMax(1e-6);
    scale_ = 0.96 * std::min(width / size.x(), height / size.y());
    offset_ = Vector3d(width / 2.0, height / 2.0, 0) -
              scale_ * Vector3d((low.x() + high.x()) / 2, (low.y() + high.y()) / 2, 0);
  }

  Vector3d operator()(const Vector3d& p) const {
    const Vector3d q = axes_ * p;
    return {scale_ * q.x() + offset_.x(), scale_ * q.y() + offset_.y(), q.z()};
  }
  Vector3d turn(const Vector3d& direction) const { return axes_ * direction; }

 private:
  Eigen::Matrix3d axes_;
  double scale_ = 1;
  Vector3d offset_{0, 0, 0};
};

class DepthBuffer {
 public:
  explicit DepthBuffer(Image& image)
      : image_(image),
        depth_(static_cast<std::size_t>(image.width()) * image.height(), -std::numeric_limits<float>::max()) {
  }

  void plot(int x, int y, double z, Colour colour) {
    if (x < 0 || y < 0 || x >= image_.width() || y >= image_.height()) {
      return;
    }
    float& depth = depth_[static_cast<std::size_t>(y) * image_.width() + x];
    if (static_cast<float>(z) > depth) {
      depth = static_cast<float>(z);
      image_.row(y)[x] = colour;
    }
  }

  /// Facing the eye, from the corner (x, y) on; what reaches beyond the picture is left out.
  void square(int x, int y, int size, double z, Colour colour) {
    const int x0 = std::max(x, 0);
    const int x1 = std::min(x + size, image_.width()) - 1;
    for (int row = std::max(y, 0); row < std::min(y + size, image_.height()); ++row) {
      fill_row(x0, x1, row, z, 0, colour);
    }
  }

  void triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, Colour colour) {
    const double doubled_area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (std::abs(doubled_area) < 1e-9) {
      return;
    }
    const int y0 = std::max(0, static_cast<int>(std::ceil(std::min({a.y(), b.y(), c.y()}))));
    const int y1 =
        std::min(image_.height() - 1, static_cast<int>(std::floor(std::max({a.y(), b.y(), c.y()}))));
    const int x0 = std::max(0, static_cast<int>(std::ceil(std::min({a.x(), b.x(), c.x()}))));
    const int x1 =
        std::min(image_.width() - 1, static_cast<int>(std::floor(std::max({a.x(), b.x(), c.x()}))));
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

  /// The pixels [first, last] of a row, of a surface whose depth grows by z_per_x from one to the next.
  void fill_row(int first, int last, int y, double z, double z_per_x, Colour colour) {
    float* const depth = depth_.data() + static_cast<std::size_t>(y) * image_.width();
    Colour* const pixels = image_.row(y);
    for (int x = first; x <= last; ++x) {
      const auto here =
          static_cast<float>(z + z_per_x * (x - first));  // no sum: that would wait for the last one
      if (here > depth[x]) {
        depth[x] = here;
        pixels[x] = colour;
      }
    }
  }

  /// The columns of a row that may lie in a triangle, one more on each side, within [x0, x1].
  static std::pair<int, int> inside_row(const std::array<Vector3d, 3>& corners, int y, int x0, int x1) {
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

  void line(const Vector3d& a, const Vector3d& b, double lift, Colour colour) {
    const int steps = std::max(1, static_cast<int>(std::ceil((b - a).head<2>().cwiseAbs().maxCoeff())));
    for (int i = 0; i <= steps; ++i) {
      const Vector3d p = a + (b - a) * (static_cast<double>(i) / steps);
      for (int thick = 0; thick < 2; ++thick) {
        plot(static_cast<int>(std::lround(p.x())) + thick, static_cast<int>(std::lround(p.y())), p.z() + lift,
             colour);
      }
    }
  }

 private:
  Image& image_;
  std::vector<float> depth_;
};

Colour shaded(Colour colour, double light) {
  const auto scaled = [light](std::uint8_t c) { return static_cast<std::uint8_t>(std::lround(c * light)); };
  return {scaled(colour.r), scaled(colour.g), scaled(colour.b)};
}

Vector3d normal_of(const Drawing& drawing, const std::array<std::int32_t, 3>& t) {
  const Vector3d& a = drawing.vertices[t[0]];
  return (drawing.vertices[t[1]] - a).cross(drawing.vertices[t[2]] - a).normalized();
}

/// Edges of drawn triangles, except those between two nearly coplanar ones.
void draw_edges(const Drawing& drawing, const std::vector<std::size_t>& drawn, const Projection& project,
                DepthBuffer& buffer) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>> edges;
  for (const std::size_t t : drawn) {
    const auto& triangle = drawing.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      edges[{low, high}].push_back(t);
    }
  }
  for (const auto& [ends, sides] : edges) {
    const bool flat =
        sides.size() == 2 &&
        normal_of(drawing, drawing.triangles[sides[0]]).dot(normal_of(drawing, drawing.triangles[sides[1]])) >
            0.9999;
    if (!flat) {
      buffer.line(project(drawing.vertices[ends.first]), project(drawing.vertices[ends.second]), 0.03,
                  {50, 50, 50});
    }
  }
}

}  // namespace

Image render(const Drawing& drawing, const View& view) {
  Image image(2 * view.width, 2 * view.height);
  DepthBuffer buffer(image);
  const Projection project(drawing, view, image.width(), image.height());
  std::vector<std::size_t> drawn;
  for (std::size_t t = 0; t < drawing.triangles.size(); ++t) {
    const auto& triangle = drawing.triangles[t];
    const Vector3d normal = project.turn(normal_of(drawing, triangle));
    if (view.look_inside && normal.z() >= -1e-6) {
      continue;
    }
    drawn.push_back(t);
    const double light = view.shade ? 0.6 + 0.4 * std::abs(normal.dot(Vector3d(0.3, -0.5, 0.81))) : 1.0;
    buffer.triangle(project(drawing.vertices[triangle[0]]), project(drawing.vertices[triangle[1]]),
                    project(drawing.vertices[triangle[2]]), shaded(drawing.triangle_colours[t], light));
  }
  if (view.edges) {
    draw_edges(drawing, drawn, project, buffer);
  }
  const int size = 2 * view.point_size;
  for (std::size_t i = 0; i < drawing.points.size(); ++i) {
    if (drawing.points[i].z() > view.z_max) {
      continue;
    }
    const Vector3d p = project(drawing.points[i]);
    buffer.square(static_cast<int>(p.x()), static_cast<int>(p.y()), size, p.z(), drawing.point_colours[i]);
  }
  return halved(image);
}

}  // namespace roomcut
