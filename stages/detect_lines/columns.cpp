// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/columns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stages/detect_lines/cell_groups.h"
#include "stages/detect_lines/outline_sight.h"

namespace roomcut::detect_lines {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
constexpr std::int32_t kApart = 2;  // cells nearer than this are one thing
constexpr std::size_t kFewestCells = 6;
constexpr double kSmallest_m = 0.15, kLargest_m = 2.0, kThinnest_m = 0.15, kSlimmest = 5;
constexpr double kReaches = 0.75;     // share of the height below the ceiling
constexpr double kSeen = 0.65;        // share of the outline
constexpr double kSeenOfMany = 0.35;  // when its size is known from others
constexpr double kLongestGap = 0.34;  // share of the outline
constexpr double kPartOf = 0.9;  // share of a group's cells that lie on the outline of which it is a part
constexpr double kHeight_m = 1.5;
constexpr double kFree = 0.45, kFreeOfLarge = 0.75, kLarge_m = 0.9;  // share of the outline, its side
constexpr double kAround_m = 0.5;
constexpr double kAlongWalls = 1.15;  // so much worse fits a column that stands as the walls do

struct Extent {
  Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
};

Vec2 position(const WallCells& cells, std::uint32_t i) {
  return {cells.x[i], cells.y[i]};
}

Extent extent_of(const WallCells& cells, const CellIndices& group) {
  Extent extent;
  for (const std::uint32_t i : group) {
    extent.low = extent.low.cwiseMin(position(cells, i));
    extent.high = extent.high.cwiseMax(position(cells, i));
  }
  return extent;
}

/// Mean of the share of the height that is occupied, weighted by area.
double reach_of(const WallCells& cells, const CellIndices& group) {
  double sum = 0, weight = 0;
  for (const std::uint32_t i : group) {
    sum += static_cast<double>(cells.area_m2[i]) * cells.coverage[i];
    weight += cells.area_m2[i];
  }
  return weight > 0 ? sum / weight : 0;
}

/// A rectangle's direction within 45 degrees of `main`.
Outline in_order(Outline outline, double main) {
  if (outline.round) return outline;
  const double quarters = std::round((outline.theta - main) / (kPi / 2));
  outline.theta -= quarters * (kPi / 2);
  if (std::fmod(std::abs(quarters), 2.0) > 0.5) std::swap(outline.half[0], outline.half[1]);
  return outline;
}

/// Groups of cells, one above the other, that may be a column, with the outline that fits them best.
struct Candidate {
  CellIndices cells;
  OutlineFit fit;
  OutlineSight sight;
  double height_m = 0;
  Extent extent;
};

/// Columns of one size.
struct SizeClass {
  Outline mean;
  std::vector<std::size_t> columns;
};

class ColumnSearch {
 public:
  ColumnSearch(const WallCells& cells, const ColumnRules& rules)
      : cells_(cells),
        rules_(rules),
        main_(main_direction(cells)),
        fit_(rules.fit),
        rms_m_(std::max({0.010, 1.2 * rules.noise_m, 0.2 * fit_.tau_m})) {}

  std::vector<Column> run() {
    CellIndices all;
    for (std::uint32_t i = 0; i < cells_.size(); ++i) all.push_back(i);
    for (const CellIndices& group : group_cells(cells_, all, fit_.tau_m, kApart)) {
      if (may_be_column(group)) stack(group);
    }
    for (const Candidate& candidate : candidates_) {
      if (is_column(candidate)) columns_.push_back(column_of(candidate));
    }
    keep_free_standing(all);
    for (const SizeClass& size : size_classes()) share(size);
    keep_free_standing(all);
    return std::move(columns_);
  }

 private:
  bool may_be_column(const CellIndices& group) const {
    if (group.size() < kFewestCells) return false;
    const Extent extent = extent_of(cells_, group);
    const Vec2 size = extent.high - extent.low;
    return size.maxCoeff() >= 0.6 * kSmallest_m && size.norm() <= 1.5 * kLargest_m &&
           reach_of(cells_, group) >= kReaches;
  }

  OutlineFit best_fit(const CellIndices& group) const {
    OutlineFit best = fit_rectangle(cells_, group, fit_);
    const OutlineFit along_walls = fit_rectangle(cells_, group, main_, fit_);
    if (along_walls.variance_m2 < kAlongWalls * best.variance_m2) best = along_walls;
    const OutlineFit circle = fit_circle(cells_, group, fit_);
    if (circle.variance_m2 < best.variance_m2) best = circle;
    best.outline = in_order(best.outline, main_);
    return best;
  }

  /// Adds the group to the candidates, or to the one below or above it.
  void stack(const CellIndices& group) {
    const OutlineFit fit = best_fit(group);
    const double height = rules_.heights[static_cast<std::size_t>(cells_.slice[group.front()])];
    const auto same = std::find_if(candidates_.begin(), candidates_.end(), [&](const Candidate& candidate) {
      return is_same_size(candidate.fit.outline, fit.outline) &&
             (candidate.fit.outline.centre - fit.outline.centre).norm() < fit_.outlier_m;
    });
    const bool alone = same == candidates_.end();
    Candidate& candidate = alone ? candidates_.emplace_back() : *same;
    candidate.cells.insert(candidate.cells.end(), group.begin(), group.end());
    candidate.height_m += height;
    candidate.extent = extent_of(cells_, candidate.cells);
    candidate.fit = alone ? fit : best_fit(candidate.cells);
    candidate.sight = sight_of(cells_, candidate.cells, candidate.fit.outline, fit_.tau_m, fit_.outlier_m);
  }

  bool is_column(const Candidate& candidate) const {
    const Outline& outline = candidate.fit.outline;
    const auto [shorter, longer] = std::minmax({2 * outline.half[0], 2 * outline.half[1]});
    return longer >= kSmallest_m && longer <= kLargest_m && shorter >= kThinnest_m &&
           longer <= kSlimmest * shorter && candidate.fit.variance_m2 <= rms_m_ * rms_m_ &&
           candidate.sight.share >= kSeen && candidate.sight.gap < kLongestGap &&
           (outline.round || candidate.sight.sides >= 3) && candidate.height_m >= kHeight_m;
  }

  static Column column_of(const Candidate& candidate) {
    return {candidate.fit.outline, candidate.sight.share, candidate.cells};
  }

  void keep_free_standing(const CellIndices& all) {
    std::erase_if(columns_, [&](const Column& column) {
      CellIndices around;
      const double reach = std::hypot(column.outline.half[0], column.outline.half[1]) + kAround_m;
      for (const std::uint32_t i : all) {
        if ((position(cells_, i) - column.outline.centre).norm() < reach &&
            is_in_slices_of(column, cells_.slice[i])) {
          around.push_back(i);
        }
      }
      const bool large = 2 * std::max(column.outline.half[0], column.outline.half[1]) > kLarge_m;
      const double share = free_share(cells_, around, column.outline, fit_.outlier_m, kAround_m);
      return share < (large ? kFreeOfLarge : kFree);
    });
  }

  bool is_in_slices_of(const Column& column, std::int32_t slice) const {
    return std::any_of(column.cells.begin(), column.cells.end(),
                       [&](std::uint32_t i) { return cells_.slice[i] == slice; });
  }

  bool is_same_size(const Outline& a, const Outline& b) const {
    return a.round == b.round && std::abs(a.half[0] - b.half[0]) < rms_m_ &&
           std::abs(a.half[1] - b.half[1]) < rms_m_;
  }

  std::vector<SizeClass> size_classes() const {
    std::vector<SizeClass> classes;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const Outline& outline = columns_[k].outline;
      const auto found = std::find_if(classes.begin(), classes.end(), [&](const SizeClass& size) {
        return is_same_size(size.mean, outline);
      });
      if (found == classes.end()) {
        classes.push_back({outline, {k}});
        continue;
      }
      found->columns.push_back(k);
      const double n = static_cast<double>(found->columns.size());
      for (std::size_t axis = 0; axis < 2; ++axis) {
        found->mean.half[axis] += (outline.half[axis] - found->mean.half[axis]) / n;
      }
    }
    return classes;
  }

  /// All columns of a class get its size; and what was seen less well joins it.
  void share(const SizeClass& size) {
    if (size.columns.size() < 2) return;
    for (const std::size_t k : size.columns) {
      Outline like = columns_[k].outline;
      like.half = size.mean.half;
      columns_[k].outline = fit_same(cells_, columns_[k].cells, like, fit_).outline;
    }
    if (size.columns.size() < 3) return;
    for (const Candidate& candidate : candidates_) {
      if (candidate.height_m >= kHeight_m && !is_column(candidate)) join(candidate, size);
    }
  }

  /// Takes what was seen of the candidate for a column of the class, if it fits: from its middle, or with one
  /// of its corners in the column's.
  void join(const Candidate& candidate, const SizeClass& size) {
    Outline like = columns_[size.columns.front()].outline;
    like.half = size.mean.half;
    const Outline box = fit_rectangle(cells_, candidate.cells, like.theta, fit_).outline;
    const Vec2 u(std::cos(like.theta), std::sin(like.theta));
    const Vec2 v(-u.y(), u.x());
    Candidate best;
    for (const double along : {0.0, -1.0, 1.0}) {
      for (const double across : {0.0, -1.0, 1.0}) {
        like.centre =
            box.centre + along * (like.half[0] - box.half[0]) * u + across * (like.half[1] - box.half[1]) * v;
        const Candidate fitted = fitted_near(fit_same(cells_, candidate.cells, like, fit_).outline);
        const bool enough = fitted.sight.share >= kSeenOfMany && (like.round || fitted.sight.sides >= 3) &&
                            fitted.fit.variance_m2 <= rms_m_ * rms_m_;
        if (enough && fitted.sight.share > best.sight.share) best = fitted;
      }
    }
    if (best.cells.empty()) return;
    const bool known = std::any_of(columns_.begin(), columns_.end(), [&](const Column& column) {
      return (column.outline.centre - best.fit.outline.centre).norm() < std::min(like.half[0], like.half[1]);
    });
    if (!known) columns_.push_back(column_of(best));
  }

  /// The candidates that are parts of the outline, and the outline of that size which fits them.
  Candidate fitted_near(const Outline& outline) const {
    Candidate fitted;
    const Vec2 reach = Vec2::Constant(std::hypot(outline.half[0], outline.half[1]) + fit_.outlier_m);
    for (const Candidate& candidate : candidates_) {
      if (((candidate.extent.low - outline.centre).array() < -reach.array()).any() ||
          ((candidate.extent.high - outline.centre).array() > reach.array()).any()) {
        continue;
      }
      const auto on = std::count_if(candidate.cells.begin(), candidate.cells.end(), [&](std::uint32_t i) {
        return std::abs(outline.distance(position(cells_, i))) < fit_.outlier_m;
      });
      if (static_cast<double>(on) < kPartOf * static_cast<double>(candidate.cells.size())) continue;
      fitted.cells.insert(fitted.cells.end(), candidate.cells.begin(), candidate.cells.end());
    }
    if (fitted.cells.empty()) return fitted;
    std::sort(fitted.cells.begin(), fitted.cells.end());
    fitted.fit = fit_same(cells_, fitted.cells, outline, fit_);
    fitted.sight = sight_of(cells_, fitted.cells, fitted.fit.outline, fit_.tau_m, fit_.outlier_m);
    return fitted;
  }

  const WallCells& cells_;
  ColumnRules rules_;
  double main_;
  OutlineRules fit_;
  double rms_m_;  ///< largest of a column's cells
  std::vector<Candidate> candidates_;
  std::vector<Column> columns_;
};

}  // namespace

std::vector<Column> find_columns(const WallCells& cells, const ColumnRules& rules) {
  return ColumnSearch(cells, rules).run();
}

double main_direction(const WallCells& cells) {
  constexpr std::size_t kBins = 90;
  std::array<double, kBins> votes{};
  const auto bin_of = [](double theta) {
    const double folded = theta - std::floor(theta / (kPi / 2)) * (kPi / 2);
    return std::min(static_cast<std::size_t>(folded / kDegree), kBins - 1);
  };
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells.boundary[i] != 0) votes[bin_of(cells.theta[i])] += cells.weight_m[i];
  }
  const auto peak = static_cast<std::size_t>(std::max_element(votes.begin(), votes.end()) - votes.begin());
  const double middle = (static_cast<double>(peak) + 0.5) * kDegree;
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double off = std::remainder(cells.theta[i] - middle, kPi / 2);
    if (cells.boundary[i] == 0 || std::abs(off) > 2 * kDegree) continue;
    sum += cells.weight_m[i] * off;
    weight += cells.weight_m[i];
  }
  return weight > 0 ? middle + sum / weight : 0;
}

}  // namespace roomcut::detect_lines
