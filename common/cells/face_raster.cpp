// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/face_raster.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace roomcut {
namespace {

using Polygon = std::vector<Vec2>;

/// Keeps the part of a convex polygon with n·p <= d.
void clip(const Polygon& in, const Vec2& n, double d, Polygon& out) {
  out.clear();
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Vec2& a = in[i];
    const Vec2& b = in[(i + 1) % in.size()];
    const double da = n.dot(a) - d;
    const double db = n.dot(b) - d;
    if (da <= 0) {
      out.push_back(a);
    }
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      out.push_back(a + (b - a) * (da / (da - db)));
    }
  }
}

double polygon_area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i - 1] - polygon[0];
    const Vec2 b = polygon[i] - polygon[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

std::pair<double, double> range_of(const Polygon& polygon, int axis) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vec2& p : polygon) {
    low = std::min(low, p[axis]);
    high = std::max(high, p[axis]);
  }
  return {low, high};
}

}  // namespace

FaceRaster::FaceRaster(const CellComplex& complex, double bin, double margin) : grid_(complex, bin) {
  const std::size_t faces = complex.faces();
  side_offset_.assign(complex.face_offset.begin(), complex.face_offset.end());
  sides_.resize(complex.face_vertex.size());
  std::vector<std::vector<std::pair<std::size_t, Piece>>> of_face(faces);
  tbb::parallel_for(std::size_t{0}, faces, [&](std::size_t f) {
    cut_into_bins(shrink(complex, f, margin), static_cast<std::int32_t>(f), of_face[f]);
  });
  first_.assign(grid_.size() + 1, 0);
  for (const auto& list : of_face) {
    for (const auto& [where, piece] : list) {
      ++first_[where + 1];
    }
  }
  for (std::size_t b = 0; b < grid_.size(); ++b) {
    first_[b + 1] += first_[b];
  }
  pieces_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const auto& list : of_face) {  // in the order of faces: pieces of a bin stay sorted
    for (const auto& [where, piece] : list) {
      pieces_[next[where]++] = piece;
    }
  }
}

FaceRaster::Polygon FaceRaster::shrink(const CellComplex& complex, std::size_t face, double margin) {
  const FaceCorners corners = complex.corners(face);
  Polygon polygon(corners.begin(), corners.end());
  HalfPlane* sides = sides_.data() + side_offset_[face];
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 along = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double length = along.norm();
    const Vec2 n = length > 0 ? Vec2(along.y() / length, -along.x() / length) : Vec2(0, 0);  // outward
    sides[i] = {n.x(), n.y(), n.dot(polygon[i])};
    double depth = 0;
    for (const Vec2& p : polygon) {
      depth = std::max(depth, sides[i].d - n.dot(p));
    }
    width = length > 0 ? std::min(width, depth) : width;
  }
  const double inset = std::min(margin, 0.2 * width);
  Polygon kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sides[i].d -= inset;
    clip(polygon, {sides[i].nx, sides[i].ny}, sides[i].d, kept);
    polygon.swap(kept);
  }
  return polygon;
}

void FaceRaster::cut_into_bins(const Polygon& polygon, std::int32_t face,
                               std::vector<std::pair<std::size_t, Piece>>& out) const {
  if (polygon.size() < 3) {
    return;
  }
  const double bin = grid_.cell;
  const auto [y_low, y_high] = range_of(polygon, 1);
  const int row_end = std::min(grid_.ny - 1, grid_.row(y_high));
  Polygon half;
  Polygon strip;
  Polygon cell;
  for (int iy = std::max(0, grid_.row(y_low)); iy <= row_end; ++iy) {
    clip(polygon, {0, -1}, -(grid_.low.y() + iy * bin), half);
    clip(half, {0, 1}, grid_.low.y() + (iy + 1) * bin, strip);
    if (strip.size() < 3) {
      continue;
    }
    const auto [x_low, x_high] = range_of(strip, 0);
    const int column_end = std::min(grid_.nx - 1, grid_.column(x_high));
    for (int ix = std::max(0, grid_.column(x_low)); ix <= column_end; ++ix) {
      clip(strip, {-1, 0}, -(grid_.low.x() + ix * bin), half);
      clip(half, {1, 0}, grid_.low.x() + (ix + 1) * bin, cell);
      const double area = cell.size() < 3 ? 0 : polygon_area(cell);
      if (area > 1e-9) {
        out.emplace_back(grid_.index(ix, iy), Piece{face, static_cast<float>(area)});
      }
    }
  }
}

std::int64_t FaceRaster::find(const Vec2& p) const {
  const int ix = grid_.column(p.x());
  const int iy = grid_.row(p.y());
  if (!grid_.contains(ix, iy)) {
    return -1;
  }
  const std::size_t bin = grid_.index(ix, iy);
  const double whole = grid_.cell * grid_.cell * (1 - 1e-6);
  for (std::uint32_t i = first_[bin]; i < first_[bin + 1]; ++i) {
    if (pieces_[i].area >= whole) {
      return i;
    }
    const auto face = static_cast<std::size_t>(pieces_[i].face);
    const auto begin = sides_.begin() + side_offset_[face];
    const auto end = sides_.begin() + side_offset_[face + 1];
    if (std::all_of(begin, end, [&](const HalfPlane& s) { return s.nx * p.x() + s.ny * p.y() <= s.d; })) {
      return i;
    }
  }
  return -1;
}

}  // namespace roomcut
