// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/picture/render.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "common/picture/depth_band.h"

namespace roomcut {

namespace {

using Eigen::Vector3d;

constexpr int kBand = 32;  // rows drawn together: even, and with their depths they fit into the cache

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

Colour shaded(Colour colour, double light) {
  const auto scaled = [light](std::uint8_t c) { return static_cast<std::uint8_t>(std::lround(c * light)); };
  return {scaled(colour.r), scaled(colour.g), scaled(colour.b)};
}

Vector3d normal_of(const Drawing& drawing, const std::array<std::int32_t, 3>& t) {
  const Vector3d& a = drawing.vertices[t[0]];
  return (drawing.vertices[t[1]] - a).cross(drawing.vertices[t[2]] - a).normalized();
}

/// The picture's parts as they lie on the screen, in the order in which they are drawn.
struct Sheet {
  struct Facet {
    Vector3d a, b, c;
    Colour colour;
  };
  struct Dot {
    int x, y;
    float z;
    Colour colour;
  };
  std::vector<Facet> facets;
  std::vector<std::pair<Vector3d, Vector3d>> lines;
  std::vector<Dot> dots;
};

/// Edges of drawn triangles, except those between two nearly coplanar ones.
void add_edges(const Drawing& drawing, const std::vector<std::size_t>& drawn, const Projection& project,
               Sheet& sheet) {
  const Vector3d lift(0, 0, 0.03);
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
      sheet.lines.emplace_back(project(drawing.vertices[ends.first]) + lift,
                               project(drawing.vertices[ends.second]) + lift);
    }
  }
}

Sheet lay_out(const Drawing& drawing, const View& view, const Projection& project) {
  Sheet sheet;
  std::vector<std::size_t> drawn;
  for (std::size_t t = 0; t < drawing.triangles.size(); ++t) {
    const auto& triangle = drawing.triangles[t];
    const Vector3d normal = project.turn(normal_of(drawing, triangle));
    if (view.look_inside && normal.z() >= -1e-6) {
      continue;
    }
    drawn.push_back(t);
    const double light = view.shade ? 0.6 + 0.4 * std::abs(normal.dot(Vector3d(0.3, -0.5, 0.81))) : 1.0;
    sheet.facets.push_back({project(drawing.vertices[triangle[0]]), project(drawing.vertices[triangle[1]]),
                            project(drawing.vertices[triangle[2]]),
                            shaded(drawing.triangle_colours[t], light)});
  }
  if (view.edges) {
    add_edges(drawing, drawn, project, sheet);
  }
  for (std::size_t i = 0; i < drawing.points.size(); ++i) {
    if (drawing.points[i].z() <= view.z_max) {
      const Vector3d p = project(drawing.points[i]);
      sheet.dots.push_back({static_cast<int>(p.x()), static_cast<int>(p.y()), static_cast<float>(p.z()),
                            drawing.point_colours[i]});
    }
  }
  return sheet;
}

/// Which dots each band of rows shows, in their order.
std::vector<std::vector<std::uint32_t>> dots_of_bands(const Sheet& sheet, int size, int height) {
  std::vector<std::vector<std::uint32_t>> bands(static_cast<std::size_t>((height + kBand - 1) / kBand));
  for (std::size_t i = 0; i < sheet.dots.size(); ++i) {
    const int first = std::max(sheet.dots[i].y, 0) / kBand;
    const int last = std::min(sheet.dots[i].y + size - 1, height - 1);
    for (int band = first; last >= 0 && band <= last / kBand; ++band) {
      bands[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(i));
    }
  }
  return bands;
}

}  // namespace

Image render(const Drawing& drawing, const View& view) {
  const int scale = view.smooth ? 2 : 1;
  const int width = scale * view.width;
  const int height = scale * view.height;
  const int dot = scale * view.point_size;
  const Sheet sheet = lay_out(drawing, view, Projection(drawing, view, width, height));
  const std::vector<std::vector<std::uint32_t>> dots = dots_of_bands(sheet, dot, height);
  Image image(view.width, view.height);
  DepthBand band(width, kBand);
  for (int first = 0; first < height; first += kBand) {
    const int end = std::min(first + kBand, height);
    band.begin(first, end - first);
    for (const Sheet::Facet& facet : sheet.facets) {
      band.triangle(facet.a, facet.b, facet.c, facet.colour);
    }
    for (const auto& [a, b] : sheet.lines) {
      band.line(a, b, {50, 50, 50});
    }
    for (const std::uint32_t i : dots[static_cast<std::size_t>(first / kBand)]) {
      const Sheet::Dot& one = sheet.dots[i];
      band.square(one.x, one.y, dot, one.z, one.colour);
    }
    for (int y = first; y < end; y += scale) {
      if (view.smooth) {
        halve_rows(band.row(y), band.row(y + 1), view.width, image.row(y / 2));
      } else {
        std::copy_n(band.row(y), view.width, image.row(y));
      }
    }
  }
  return image;
}

}  // namespace roomcut
