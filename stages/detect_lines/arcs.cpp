// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/arcs.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "stages/detect_lines/arc_cells.h"
#include "stages/detect_lines/arc_choice.h"

namespace roomcut::detect_lines {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
constexpr double kSmallest_m = 0.3, kLargest_m = 30;  // radius
constexpr double kLeastSweep = 20 * kDegree;
constexpr double kShortest_m = 0.5;
constexpr double kSeen = 0.8;     // share of the length
constexpr double kReaches = 0.3;  // share of the height of the slices' evidence
constexpr double kLeastGain = 10;
constexpr double kStraight_m = 1.0;  // lines this long tell whether they bend
constexpr double kBent_m = 0.008;    // sagitta of a line that bends
constexpr double kSeeds_m = 0.15;    // from one try to the next
constexpr std::array<double, 3> kWindows_m = {0.3, 0.8, 2.0};
constexpr double kSagitta_m = 0.004;  // of a window that may be part of an arc
constexpr double kInlierAngle = 20 * kDegree;
constexpr double kClose_m = 0.15;  // cells nearer than this are one run
constexpr int kGrowths = 16, kSettlings = 5, kWideRounds = 2;
constexpr int kOffInRow = 4;
// Shares of a stretch that are surely of the arc: most fits best, fewer where the stretch runs far beyond it.
constexpr std::array<double, 2> kMiddles = {0.7, 0.5};
constexpr double kClosing = 0.2;  // share of a circle that may be missing from a whole one

Vec2 position(const WallCells& cells, std::uint32_t i) {
  return {cells.x[i], cells.y[i]};
}

/// Sagitta of the parabola through the cells' distances from the line, over its length [m].
double sagitta_of(const WallCells& cells, const LineCandidate& line) {
  const double middle = 0.5 * (line.support.t0 + line.support.t1);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-9;
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : line.support.cells) {
    const double t = line.line.along(position(cells, i)) - middle;
    const Eigen::Vector3d row(1, t, t * t);
    normal += static_cast<double>(cells.area_m2[i]) * row * row.transpose();
    right += static_cast<double>(cells.area_m2[i]) * line.line.distance(position(cells, i)) * row;
  }
  const double half = 0.5 * (line.support.t1 - line.support.t0);
  return std::abs(normal.ldlt().solve(right)(2)) * half * half;
}

class ArcSearch {
 public:
  ArcSearch(const WallCells& cells, const std::vector<LineCandidate>& lines, const CellIndices& columns,
            const ArcRules& rules)
      : cells_(cells),
        rules_(rules),
        squares_(cells, 3 * rules.tau_m),
        inlier_m_(std::max(0.015, 2.5 * rules.noise_m)),
        cauchy_m_(std::max(0.005, rules.noise_m)),
        tried_(cells.size(), false),
        taken_(cells.size(), false) {
    for (const LineCandidate& line : lines) {
      if (line.support.t1 - line.support.t0 < kStraight_m) continue;
      if (sagitta_of(cells, line) > std::max(kBent_m, rules.noise_m)) continue;
      for (const std::uint32_t i : line.support.cells) tried_[i] = true;
    }
    for (const std::uint32_t i : columns) tried_[i] = taken_[i] = true;
  }

  std::vector<Arc> run() {
    std::vector<Arc> arcs;
    for (std::uint32_t seed = 0; seed < cells_.size(); ++seed) {
      if (tried_[seed] || cells_.boundary[seed] == 0) continue;
      if (std::optional<Arc> arc = arc_at(seed)) arcs.push_back(std::move(*arc));
    }
    return arcs;
  }

 private:
  std::optional<Arc> arc_at(std::uint32_t seed) {
    std::size_t before = 0;
    for (const double window_m : kWindows_m) {
      CellIndices chain = squares_.chain(seed, window_m);
      std::erase_if(chain, [&](std::uint32_t i) { return taken_[i]; });
      for (const std::uint32_t i : chain) {
        if ((position(cells_, i) - position(cells_, seed)).norm() < kSeeds_m) tried_[i] = true;
      }
      if (chain.size() < 6 || chain.size() == before) return std::nullopt;  // it goes on no farther
      before = chain.size();
      Bend bend{position(cells_, seed), Line2{cells_.theta[seed], 0}.normal(), 0};
      bend = fit_bend(cells_, chain, fit_bend(cells_, chain, bend, cauchy_m_, true), cauchy_m_);
      const double sagitta = 0.5 * std::abs(bend.curvature) * window_m * window_m;
      if (sagitta < std::max(kSagitta_m, 0.5 * rules_.noise_m)) continue;
      if (std::optional<Arc> arc = grown(bend)) {
        for (const std::uint32_t i : arc->cells) tried_[i] = taken_[i] = true;
        return arc;
      }
    }
    return std::nullopt;
  }

  bool is_possible(const Bend& bend) const {
    return std::abs(bend.curvature) > 0.7 / kLargest_m && std::abs(bend.curvature) < 1.3 / kSmallest_m;
  }

  bool is_on(const Bend& bend, std::uint32_t i) const {
    if (taken_[i] || cells_.boundary[i] == 0) return false;
    const Vec2 out = position(cells_, i) - bend.centre();
    return angle_between(cells_.theta[i], std::atan2(out.y(), out.x())) < kInlierAngle;
  }

  CellIndices on_circle(const Bend& bend, const Stretch& stretch) const {
    CellIndices cells = squares_.along_circle(bend, stretch, inlier_m_);
    std::erase_if(cells, [&](std::uint32_t i) { return !is_on(bend, i); });
    return cells;
  }

  /// The circle that begins with the bend, over all the cells that follow it.
  std::optional<Arc> grown(Bend bend) const {
    Stretch stretch{-0.1, 0.1};
    std::size_t before = 0;
    for (int round = 0; round < kGrowths; ++round) {
      if (!is_possible(bend)) return std::nullopt;
      const double longer = std::max(0.3, 0.5 * stretch.length());
      const double half = kPi * bend.radius();
      const Stretch reach{std::max(-half, stretch.low - longer), std::min(half, stretch.high + longer)};
      const CellIndices near = on_circle(bend, reach);
      const std::optional<Stretch> covered = covered_from_start(bend, near);
      if (!covered) return std::nullopt;
      stretch = *covered;
      const CellIndices group = within(bend, near, stretch);
      if (group.size() < 6) return std::nullopt;
      bend = fit_bend(cells_, group, bend, cauchy_m_);
      if (group.size() == before) break;
      before = group.size();
    }
    if (!is_possible(bend)) return std::nullopt;
    for (const double middle : kMiddles) {
      if (std::optional<Arc> arc = judged(middle, bend, stretch)) return arc;
    }
    return std::nullopt;
  }

  CellIndices within(const Bend& bend, CellIndices cells, const Stretch& stretch) const {
    std::erase_if(cells, [&](std::uint32_t i) {
      const double at = along(bend, position(cells_, i));
      return at < stretch.low || at > stretch.high;
    });
    return cells;
  }

  /// The stretch around the bend's point that cells cover. It goes on behind a gap when both sides of that
  /// are long enough for it: what lies on the circle by chance is short.
  std::optional<Stretch> covered_from_start(const Bend& bend, const CellIndices& cells) const {
    std::vector<double> places;
    for (const std::uint32_t i : cells) places.push_back(along(bend, position(cells_, i)));
    std::sort(places.begin(), places.end());
    std::vector<Stretch> runs;
    for (const double place : places) {
      if (runs.empty() || place - runs.back().high > kClose_m) runs.push_back({place, place});
      runs.back().high = place;
    }
    const auto start = std::find_if(runs.begin(), runs.end(), [](const Stretch& run) {
      return run.low <= kClose_m && run.high >= -kClose_m;
    });
    if (start == runs.end()) return std::nullopt;
    Stretch all = *start;
    const auto bridges = [&](double gap, const Stretch& next) {
      return gap <= std::min({rules_.max_gap_m, all.length(), 2 * next.length()});
    };
    for (auto next = start + 1; next != runs.end() && bridges(next->low - all.high, *next); ++next) {
      all.high = next->high;
    }
    for (auto next = std::make_reverse_iterator(start);
         next != runs.rend() && bridges(all.low - next->high, *next); ++next) {
      all.low = next->low;
    }
    return all;
  }

  std::size_t bins_in(const Stretch& stretch) const {
    const double wanted = std::max(1.5 * rules_.tau_m, std::min(0.15, stretch.length() / 24));
    return static_cast<std::size_t>(std::max(1.0, std::floor(stretch.length() / wanted)));
  }

  /// The stretch in short pieces, as far as there are cells.
  std::vector<ArcBin> bins_of(const Bend& bend, const Stretch& stretch) const {
    const std::size_t count = bins_in(stretch);
    const double length = stretch.length() / static_cast<double>(count);
    std::vector<ArcBin> bins(count);
    for (const std::uint32_t i : on_circle(bend, stretch)) {
      const Vec2 p = position(cells_, i);
      const auto k = std::min(count - 1, static_cast<std::size_t>((along(bend, p) - stretch.low) / length));
      const double w = cells_.area_m2[i];
      bins[k].weight += w;
      bins[k].mean += w * p;
      bins[k].distance_m += w * bend.distance(p);
      bins[k].cells.push_back(i);
    }
    std::vector<ArcBin> seen;
    for (std::size_t k = 0; k < count; ++k) {
      if (bins[k].cells.empty()) continue;
      bins[k].at = stretch.low + (static_cast<double>(k) + 0.5) * length;
      bins[k].mean /= bins[k].weight;
      bins[k].distance_m /= bins[k].weight;
      seen.push_back(std::move(bins[k]));
    }
    return seen;
  }

  /// What the means of bins scatter by at least: nothing is built more exactly.
  double floor_m() const { return std::max(0.001, 0.15 * rules_.noise_m); }

  /// Fits the circle to the middle of the stretch, then to all that lies on it from there on: a straight wall
  /// that goes on from an arc leaves it slowly.
  bool settle(double middle, Bend& bend, Stretch& stretch) const {
    const Stretch whole = stretch;
    const double spare = 0.5 * (1 - middle) * whole.length();
    stretch = {whole.low + spare, whole.high - spare};
    for (int round = 0; round < kSettlings; ++round) {
      const CellIndices group = on_circle(bend, stretch);
      if (group.size() < 6) return false;
      bend = fit_bend(cells_, group, bend, cauchy_m_);
      if (!is_possible(bend)) return false;
      stretch = on_it_from_middle(middle, bend, whole, round < kWideRounds ? 2 : 1);
    }
    return true;
  }

  /// `wide`: how many times farther off still is on the circle: the first fits are worse.
  Stretch on_it_from_middle(double middle, const Bend& bend, const Stretch& whole, double wide) const {
    const std::vector<ArcBin> bins = bins_of(bend, whole);
    const double half = 0.5 * whole.length() / static_cast<double>(bins_in(whole));
    const double limit = wide * std::max(0.0025, 0.6 * rules_.noise_m);
    const double spare = 0.5 * (1 - middle) * whole.length();
    Stretch stretch{whole.low + spare, whole.high - spare};
    const auto follow = [&](auto begin, auto end, auto is_beyond, auto take) {
      int off = 0;  // in a row: some may be of something before the wall
      bool again = true;
      for (auto bin = begin; bin != end && off < kOffInRow; ++bin) {
        if (!is_beyond(*bin)) continue;
        const bool on = std::abs(bin->distance_m) <= limit;
        off = on ? 0 : off + 1;
        if (on && again) take(*bin);
        again = on;  // behind those that are off one on the circle may be chance
      }
    };
    follow(
        bins.begin(), bins.end(), [&](const ArcBin& bin) { return bin.at > stretch.high; },
        [&](const ArcBin& bin) { stretch.high = bin.at + half; });
    follow(
        bins.rbegin(), bins.rend(), [&](const ArcBin& bin) { return bin.at < stretch.low; },
        [&](const ArcBin& bin) { stretch.low = bin.at - half; });
    return stretch;
  }

  std::optional<Arc> judged(double middle, Bend bend, Stretch stretch) const {
    if (!settle(middle, bend, stretch)) return std::nullopt;
    const double radius = bend.radius();
    const double sweep = stretch.length() / radius;
    const std::vector<ArcBin> bins = without_outliers(bins_of(bend, stretch));
    double squares = 0, reach = 0, area = 0;
    for (const ArcBin& bin : bins) {
      squares += bin.weight * bin.distance_m * bin.distance_m;
      for (const std::uint32_t i : bin.cells) {
        reach += static_cast<double>(cells_.area_m2[i]) * cells_.coverage[i];
        area += cells_.area_m2[i];
      }
    }
    const double rms = std::sqrt(squares / area);
    const double share = seen_share(bend, stretch);
    const double sagitta = radius * (1 - std::cos(std::min(kPi, 0.5 * sweep)));
    if (radius < kSmallest_m || radius > kLargest_m || sweep < kLeastSweep ||
        stretch.length() < kShortest_m || share < kSeen || reach < kReaches * area ||
        rms > std::max(0.004, 0.6 * rules_.noise_m) || sagitta < std::max(0.02, 3 * rules_.noise_m) ||
        !circle_beats_polyline(bins, floor_m(), kLeastGain)) {
      return std::nullopt;
    }
    return arc_of(bend, stretch, share);
  }

  double seen_share(const Bend& bend, const Stretch& stretch) const {
    const double step = 1.5 * rules_.tau_m;
    const auto count = static_cast<std::size_t>(std::ceil(stretch.length() / step));
    std::vector<std::uint8_t> seen(std::max<std::size_t>(1, count), 0);
    for (const std::uint32_t i : on_circle(bend, stretch)) {
      const auto k = static_cast<std::size_t>((along(bend, position(cells_, i)) - stretch.low) / step);
      seen[std::min(k, seen.size() - 1)] = 1;
    }
    return static_cast<double>(std::accumulate(seen.begin(), seen.end(), 0)) /
           static_cast<double>(seen.size());
  }

  Arc arc_of(const Bend& bend, const Stretch& stretch, double share) const {
    Arc arc;
    arc.centre = bend.centre();
    arc.radius_m = bend.radius();
    arc.seen = share;
    const Vec2 start = bend.point - arc.centre;
    const double azimuth = std::atan2(start.y(), start.x());
    arc.from = azimuth + stretch.low / arc.radius_m;
    arc.to = azimuth + stretch.high / arc.radius_m;
    Stretch all = stretch;
    const double missing = 2 * kPi * arc.radius_m - stretch.length();
    if (missing < std::min(rules_.max_gap_m, kClosing * 2 * kPi * arc.radius_m)) {
      arc.to = arc.from + 2 * kPi;
      all = {-kPi * arc.radius_m, kPi * arc.radius_m};
      arc.seen *= stretch.length() / (2 * kPi * arc.radius_m);
    }
    arc.cells = squares_.along_circle(bend, all, inlier_m_);
    std::erase_if(arc.cells, [&](std::uint32_t i) { return taken_[i]; });
    return arc;
  }

  const WallCells& cells_;
  ArcRules rules_;
  CellSquares squares_;
  double inlier_m_, cauchy_m_;
  std::vector<std::uint8_t> tried_, taken_;
};

}  // namespace

std::vector<Arc> find_arcs(const WallCells& cells, const std::vector<LineCandidate>& lines,
                           const CellIndices& columns, const ArcRules& rules) {
  return ArcSearch(cells, lines, columns, rules).run();
}

std::vector<LineCandidate> chords_of(const WallCells& cells, const Arc& arc, double noise_m) {
  const double sagitta = std::min(std::max(0.005, noise_m), 0.3 * arc.radius_m);
  const double widest = 2 * std::acos(1 - sagitta / arc.radius_m);
  const double sweep = arc.to - arc.from;
  const auto count = static_cast<std::size_t>(std::ceil(sweep / widest - 1e-9));
  const double half = 0.5 * sweep / static_cast<double>(count);
  const double apothem = arc.radius_m * std::sqrt(half / std::tan(half));
  std::vector<LineCandidate> chords;
  for (std::size_t k = 0; k < count; ++k) {
    const double azimuth = arc.from + (2 * static_cast<double>(k) + 1) * half;
    LineCandidate chord;
    chord.line = normalised(azimuth, Line2{azimuth, 0}.normal().dot(arc.centre) + apothem);
    const Vec2 foot = arc.centre + apothem * Line2{azimuth, 0}.normal();
    const double middle = chord.line.along(foot);
    const double end = apothem * std::tan(half);
    chord.support = {middle - end, middle + end, 2 * end * arc.seen, {}};
    chords.push_back(std::move(chord));
  }
  for (const std::uint32_t i : arc.cells) {
    const Vec2 out = position(cells, i) - arc.centre;
    double turn = std::atan2(out.y(), out.x()) - arc.from;
    turn -= 2 * kPi * std::floor(turn / (2 * kPi));
    const auto k = static_cast<std::size_t>(turn / (2 * half));
    if (k < count) chords[k].support.cells.push_back(i);
  }
  return chords;
}

}  // namespace roomcut::detect_lines
