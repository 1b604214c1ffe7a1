// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/columns.h"

#include <algorithm>
#include <limits>

namespace roomcut::extract {

namespace {

constexpr double kWeld_m = 5 * kPlanSnap_m;  // creases of slopes up to 5

/// A corner of a plan face, and how high the one plane lies over the other there.
struct Corner {
  Vec2 p;
  double height;
};

/// The part of a convex polygon where the height is not negative.
std::vector<Corner> positive_part(const std::vector<Corner>& polygon) {
  std::vector<Corner> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner& a = polygon[i];
    const Corner& b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    if (a.height >= 0) {
      part.push_back(a);
    }
    if (a.height * b.height < 0) {
      const double t = a.height / (a.height - b.height);
      part.push_back({a.p + t * (b.p - a.p), 0});
    }
  }
  return part;
}

/// Volume under heights that are given at the corners, as a fan around the first one.
double prism_volume(const std::vector<Corner>& polygon) {
  double six_volumes = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 u = polygon[i].p - polygon[0].p;
    const Vec2 v = polygon[i + 1].p - polygon[0].p;
    six_volumes +=
        (u.x() * v.y() - u.y() * v.x()) * (polygon[0].height + polygon[i].height + polygon[i + 1].height);
  }
  return six_volumes / 6;
}

/// The least height of `upper` over `lower` at the corners of a face.
double clearance(const EndHeights& heights, std::size_t face, const RunEnd& lower, const RunEnd& upper) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& p : heights.complex().corners(face)) {
    least = std::min(least, heights.z(upper, p) - heights.z(lower, p));
  }
  return least;
}

}  // namespace

Columns columns_of(const EndHeights& heights, const std::vector<std::uint8_t>& label,
                   const Storeys& storeys) {
  const CellComplex& complex = heights.complex();
  Columns columns;
  columns.offset.assign(complex.faces() + 1, 0);
  for_each_run(complex, label, [&](std::size_t face, std::size_t first, std::size_t last) {
    columns.runs.push_back({static_cast<std::int32_t>(face), storeys.of_cell[complex.cell(face, first)],
                            heights.end(face, first), heights.end(face, last)});
    ++columns.offset[face + 1];
  });
  for (std::size_t face = 0; face < complex.faces(); ++face) {
    columns.offset[face + 1] += columns.offset[face];
  }
  return columns;
}

double weld_distance(const CellComplex& complex) {
  double weld = kWeld_m;
  for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
    weld = std::min(weld, 0.4 * complex.height(layer));
  }
  return weld;
}

std::vector<std::size_t> keep_slabs(const CellComplex& complex, LevelSurfaces& surfaces, Columns& columns) {
  std::vector<std::size_t> put_back;
  const EndHeights heights(complex, surfaces);
  const double thinnest = 2 * weld_distance(complex);
  const auto put_back_end = [&](std::int32_t face, RunEnd& end) {
    if (end.surface >= 0) {
      end.surface = -1;
      put_back.push_back(
          complex.level_face(static_cast<std::size_t>(face), static_cast<std::size_t>(end.level)));
      surfaces.of_face[put_back.back()] = -1;
    }
  };
  for (std::size_t i = 0; i + 1 < columns.runs.size(); ++i) {
    Run& below = columns.runs[i];
    Run& above = columns.runs[i + 1];
    if (below.face == above.face && (below.upper.surface >= 0 || above.lower.surface >= 0) &&
        clearance(heights, static_cast<std::size_t>(below.face), below.upper, above.lower) < thinnest) {
      put_back_end(below.face, below.upper);
      put_back_end(above.face, above.lower);
    }
  }
  std::sort(put_back.begin(), put_back.end());
  return put_back;
}

double volume_between(const EndHeights& heights, std::size_t face, const RunEnd& lower, const RunEnd& upper) {
  const CellComplex& complex = heights.complex();
  if (!heights.is_sloped(lower) && !heights.is_sloped(upper)) {
    const Vec2& anywhere = complex.corners(face)[0];
    return complex.area(face) * std::max(0.0, heights.z(upper, anywhere) - heights.z(lower, anywhere));
  }
  std::vector<Corner> polygon;
  for (const Vec2& p : complex.corners(face)) {
    polygon.push_back({p, heights.z(upper, p) - heights.z(lower, p)});
  }
  return prism_volume(positive_part(polygon));
}

}  // namespace roomcut::extract
