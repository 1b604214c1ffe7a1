// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/line_grid.h"

#include <algorithm>
#include <utility>

namespace roomcut::weigh_faces {
namespace {

constexpr double kBin = 0.25;  // about the reach: few lines per bin, few bins per edge

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double squared = along.squaredNorm();
  const double s = squared > 0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (p - a - s * along).norm();
}

}  // namespace

LineGrid::LineGrid(const CellComplex& complex, double reach, double azimuth) : grid_(complex, kBin) {
  for (const CellComplex::Line& l : complex.lines) {
    std::vector<std::uint8_t> carries;
    for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
      carries.push_back(l.carries(layer) ? 1 : 0);
    }
    plan_lines_.push_back({l.line.normal(), l.line.direction(), l.line.d, l.line.theta, carries,
                           azimuths_on(l.line.theta, azimuth)});
  }
  std::vector<std::pair<std::size_t, std::int32_t>> entries;
  const double touch = reach + kBin * 0.7072;  // half a bin's diagonal
  for (const CellComplex::Edge& edge : complex.edges) {
    if (!complex.on_wall_line(edge)) {
      continue;
    }
    const Vec2& a = complex.vertices[static_cast<std::size_t>(edge.v0)];
    const Vec2& b = complex.vertices[static_cast<std::size_t>(edge.v1)];
    const int x0 = std::max(0, grid_.column(std::min(a.x(), b.x()) - reach));
    const int x1 = std::min(grid_.nx - 1, grid_.column(std::max(a.x(), b.x()) + reach));
    const int y0 = std::max(0, grid_.row(std::min(a.y(), b.y()) - reach));
    const int y1 = std::min(grid_.ny - 1, grid_.row(std::max(a.y(), b.y()) + reach));
    for (int iy = y0; iy <= y1; ++iy) {
      for (int ix = x0; ix <= x1; ++ix) {
        const Vec2 middle = grid_.low + kBin * Vec2(ix + 0.5, iy + 0.5);
        if (distance_to_segment(middle, a, b) <= touch) {
          entries.emplace_back(grid_.index(ix, iy), edge.line);
        }
      }
    }
  }
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  first_.assign(grid_.size() + 1, 0);
  lines_.reserve(entries.size());
  for (const auto& [bin, line] : entries) {
    ++first_[bin + 1];
    lines_.push_back(line);
  }
  for (std::size_t b = 0; b < grid_.size(); ++b) {
    first_[b + 1] += first_[b];
  }
}

}  // namespace roomcut::weigh_faces
