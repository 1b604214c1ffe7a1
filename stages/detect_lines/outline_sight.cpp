// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/outline_sight.h"

#include <algorithm>
#include <cmath>

namespace roomcut::detect_lines {
namespace {

constexpr double kSideSeen = 0.4;
constexpr double kRingPieces = 36;

/// Pieces of equal length along an outline, each seen or not.
class Pieces {
 public:
  Pieces(const Outline& outline, double pieces)
      : outline_(outline),
        perimeter_(outline.perimeter_m()),
        seen_(static_cast<std::size_t>(std::clamp(std::floor(pieces), 4.0, 48.0)), false) {}

  void see(const Vec2& p) {
    const double t = outline_.along(p) / perimeter_ * static_cast<double>(seen_.size());
    seen_[std::min(static_cast<std::size_t>(std::max(0.0, t)), seen_.size() - 1)] = true;
  }

  double share() const {
    return part(static_cast<std::size_t>(std::count(seen_.begin(), seen_.end(), true)));
  }

  double longest_gap() const {
    std::size_t run = 0, longest = 0;
    for (std::size_t k = 0; k < 2 * seen_.size(); ++k) {  // twice around
      run = seen_[k % seen_.size()] ? 0 : run + 1;
      longest = std::max(longest, std::min(run, seen_.size()));
    }
    return part(longest);
  }

  /// Share of the pieces seen whose middles lie from `begin` to `end` [m].
  double share_between(double begin, double end) const {
    int all = 0, with = 0;
    for (std::size_t k = 0; k < seen_.size(); ++k) {
      const double t = (static_cast<double>(k) + 0.5) * part(1) * perimeter_;
      if (t < begin || t >= end) continue;
      ++all;
      with += seen_[k] ? 1 : 0;
    }
    return all > 0 ? static_cast<double>(with) / all : 0;
  }

 private:
  double part(std::size_t n) const { return static_cast<double>(n) / static_cast<double>(seen_.size()); }

  const Outline& outline_;
  double perimeter_;
  std::vector<bool> seen_;
};

}  // namespace

OutlineSight sight_of(const WallCells& cells, const CellIndices& group, const Outline& outline,
                      double piece_m, double near_m) {
  Pieces pieces(outline, outline.perimeter_m() / piece_m);
  for (const std::uint32_t i : group) {
    const Vec2 p(cells.x[i], cells.y[i]);
    if (std::abs(outline.distance(p)) <= near_m) pieces.see(p);
  }
  OutlineSight sight{pieces.share(), pieces.longest_gap(), 0};
  if (outline.round) return sight;
  double begin = 0;
  for (const std::size_t axis : {1U, 0U, 1U, 0U}) {
    const double end = begin + 2 * outline.half[axis];
    sight.sides += pieces.share_between(begin, end) >= kSideSeen ? 1 : 0;
    begin = end;
  }
  return sight;
}

double free_share(const WallCells& cells, const CellIndices& around, const Outline& outline, double near_m,
                  double far_m) {
  Pieces pieces(outline, kRingPieces);
  for (const std::uint32_t i : around) {
    const Vec2 p(cells.x[i], cells.y[i]);
    const double distance = outline.distance(p);
    if (distance > near_m && distance <= far_m) pieces.see(p);
  }
  return 1 - pieces.share();
}

}  // namespace roomcut::detect_lines
