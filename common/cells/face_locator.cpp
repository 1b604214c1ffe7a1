// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/face_locator.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace roomcut {

namespace {

constexpr double kFinest_m = 0.1;  // edge of a bin: memory stays small however many faces are slivers

double bin_of(const CellComplex& complex) {
  double area = 0;
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    area += complex.area(f);
  }
  return std::max(kFinest_m,
                  std::sqrt(area / static_cast<double>(std::max<std::size_t>(1, complex.faces()))));
}

template <class Points>
std::pair<Vec2, Vec2> box_of(const Points& points) {
  Vec2 low = *points.begin();
  Vec2 high = low;
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {low, high};
}

/// Whether p lies left of the side, which rises from `low` to `high`: both faces at it get the same answer.
bool is_left(const Vec2& low, const Vec2& high, const Vec2& p) {
  return (high.x() - low.x()) * (p.y() - low.y()) - (high.y() - low.y()) * (p.x() - low.x()) > 0;
}

}  // namespace

FaceLocator::FaceLocator(const CellComplex& complex) : complex_(complex), grid_(complex, bin_of(complex)) {
  if (complex.faces() == 0) {
    return;
  }
  std::tie(low_, high_) = box_of(complex.vertices);
  std::vector<std::pair<std::size_t, std::int32_t>> entries;  // bin, face
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    const auto [low, high] = box_of(complex.corners(f));
    for (int iy = grid_.row(low.y()); iy <= grid_.row(high.y()); ++iy) {
      for (int ix = grid_.column(low.x()); ix <= grid_.column(high.x()); ++ix) {
        if (grid_.contains(ix, iy)) {
          entries.emplace_back(grid_.index(ix, iy), static_cast<std::int32_t>(f));
        }
      }
    }
  }
  std::sort(entries.begin(), entries.end());
  first_.assign(grid_.size() + 1, 0);
  faces_.reserve(entries.size());
  for (const auto& [bin, face] : entries) {
    ++first_[bin + 1];
    faces_.push_back(face);
  }
  for (std::size_t bin = 0; bin < grid_.size(); ++bin) {
    first_[bin + 1] += first_[bin];
  }
}

/// A level line through p crosses two sides of a convex face, if any: p lies right of the falling one, the
/// left side, and left of the rising one. Along that line every face ends at the side where the next one
/// begins, so that each point has one, whatever rounding does at slivers and where sides bend.
bool FaceLocator::contains(std::size_t face, const Vec2& p) const {
  const FaceCorners corners = complex_.corners(face);
  bool crossed = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& a = corners[i];
    const Vec2& b = corners.after(i);
    const bool rises = a.y() <= p.y() && p.y() < b.y();
    const bool falls = b.y() <= p.y() && p.y() < a.y();
    if (rises || falls) {
      if (rises ? !is_left(a, b, p) : is_left(b, a, p)) {
        return false;
      }
      crossed = true;
    }
  }
  return crossed;
}

std::int32_t FaceLocator::face_at(const Vec2& p) const {
  if (first_.empty() ||
      !(p.x() >= low_.x() && p.y() >= low_.y() && p.x() <= high_.x() && p.y() <= high_.y())) {
    return -1;
  }
  // Right and upper side of the box have no face beyond: they belong to the last one.
  const Vec2 inside(std::min(p.x(), std::nextafter(high_.x(), low_.x())),
                    std::min(p.y(), std::nextafter(high_.y(), low_.y())));
  const int ix = std::min(grid_.column(inside.x()), grid_.nx - 1);
  const int iy = std::min(grid_.row(inside.y()), grid_.ny - 1);
  const std::size_t bin = grid_.index(ix, iy);
  const auto begin = faces_.begin() + first_[bin];
  const auto end = faces_.begin() + first_[bin + 1];
  const auto found = std::find_if(
      begin, end, [&](std::int32_t face) { return contains(static_cast<std::size_t>(face), inside); });
  return found == end ? -1 : *found;
}

std::int64_t FaceLocator::cell_at(const Vec3& p) const {
  const std::int32_t face = face_at(p.head<2>());
  const std::int32_t layer = complex_.layer_at(p.z());
  return face < 0 || layer < 0 ? -1
                               : static_cast<std::int64_t>(complex_.cell(static_cast<std::size_t>(face),
                                                                         static_cast<std::size_t>(layer)));
}

}  // namespace roomcut
