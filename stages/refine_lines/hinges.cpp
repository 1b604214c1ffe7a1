// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/hinges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace roomcut::refine_lines {
namespace {

constexpr double kDeg = std::numbers::pi / 180;
constexpr double kLeast_rad = 3 * kDeg, kMost_rad = 20 * kDeg;
constexpr double kShortest_m = 0.3;
constexpr double kStraight_m = 0.004;  // what the observations of a wall scatter beyond their sigma
constexpr double kMeet_m = 0.01;
constexpr double kMisfitLeft = 0.25;
constexpr double kFewest = 4;  // observations on each side

/// Sums of a straight line e = a + b t through weighted observations.
struct LineSums {
  double count = 0, w = 0, wt = 0, we = 0, wtt = 0, wte = 0, wee = 0;
  double t0 = std::numeric_limits<double>::max(), t1 = std::numeric_limits<double>::lowest();

  void add(double t, double e, double weight) {
    count += 1;
    w += weight;
    wt += weight * t;
    we += weight * e;
    wtt += weight * t * t;
    wte += weight * t * e;
    wee += weight * e * e;
    t0 = std::min(t0, t);
    t1 = std::max(t1, t);
  }
  double slope() const {
    const double spread = w * wtt - wt * wt;
    return spread > 0 ? (w * wte - wt * we) / spread : 0;
  }
  double at(double t) const { return (we - slope() * wt) / w + slope() * t; }
  /// Weighted squares that the line leaves.
  double misfit() const {
    const double a = at(0);
    return std::max(0.0, wee - a * we - slope() * wte);
  }
  bool is_wall() const { return count >= kFewest && t1 - t0 >= kShortest_m && misfit() <= count; }
};

Line2 line_of(const LineSums& sums, const Line2& along) {
  const auto place = [&](double t) { return Vec2(along.at(t) + sums.at(t) * along.normal()); };
  return line_through(place(sums.t0), place(sums.t1));
}

}  // namespace

std::optional<Hinge> find_hinge(const FittedLine& fitted) {
  const std::size_t bins = fitted.faces->bins;
  std::vector<LineSums> before(bins + 1);
  std::vector<LineSums> behind(bins + 1);
  std::vector<std::vector<const Observation*>> of_bin(bins);
  for (const Observation& o : *fitted.observations) {
    of_bin[o.bin].push_back(&o);
  }
  const auto add = [&](std::size_t bin, LineSums& sums) {
    for (const Observation* o : of_bin[bin]) {
      sums.add(fitted.line.along(o->point), fitted.line.distance(o->point),
               1 / (o->variance_m2 + kStraight_m * kStraight_m));
    }
  };
  for (std::size_t bin = 0; bin < bins; ++bin) {
    before[bin + 1] = before[bin];
    add(bin, before[bin + 1]);
  }
  for (std::size_t bin = bins; bin-- > 0;) {
    behind[bin] = behind[bin + 1];
    add(bin, behind[bin]);
  }
  std::optional<Hinge> best;
  double least = bins > 0 ? kMisfitLeft * behind[0].misfit() : 0;
  for (std::size_t bin = 1; bin < bins; ++bin) {
    const LineSums& a = before[bin];
    const LineSums& b = behind[bin];
    if (!a.is_wall() || !b.is_wall() || a.misfit() + b.misfit() >= least) {
      continue;
    }
    const double turn = std::abs(std::atan(a.slope()) - std::atan(b.slope()));
    const double t = 0.5 * (a.t1 + b.t0);
    if (turn >= kLeast_rad && turn <= kMost_rad && std::abs(a.at(t) - b.at(t)) <= kMeet_m) {
      best = {bin, line_of(a, fitted.line), line_of(b, fitted.line)};
      least = a.misfit() + b.misfit();
    }
  }
  return best;
}

}  // namespace roomcut::refine_lines
