// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/mean_shift.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace roomcut::detect_lines {
namespace {

constexpr double kReach = 3;         // standard deviations at which the kernel ends
constexpr double kSupportReach = 2;  // … within which votes are a mode's
constexpr double kStill = 0.01;      // bins; a shorter step has arrived
constexpr double kSame = 0.5;        // bins (and standard deviations): modes so near are one
constexpr int kIterations = 200;

/// A place in the accumulator, in bins; whole numbers are the middles of bins.
struct Place {
  double angle = 0, distance = 0;
};

struct Sum {
  double votes = 0, weight = 0;
  Place step;  ///< weighted, from the middle of the window
};

class MeanShift {
 public:
  MeanShift(const HoughAccumulator& votes, const Bandwidth& bandwidth)
      : votes_(votes),
        angles_(static_cast<std::ptrdiff_t>(votes.angles())),
        distances_(static_cast<std::ptrdiff_t>(votes.distances())),
        sigma_{std::max(kSame, bandwidth.angle_rad / votes.angle_step()),
               std::max(kSame, bandwidth.distance_m / votes.distance_step())} {}

  std::vector<Place> starts() const {
    std::vector<Place> found;
    for (std::ptrdiff_t a = 0; a < angles_; ++a) {
      for (std::ptrdiff_t d = 1; d + 1 < distances_; ++d) {
        if (is_summit(a, d)) found.push_back({static_cast<double>(a), static_cast<double>(d)});
      }
    }
    return found;
  }

  Place climb(Place place) const {
    for (int i = 0; i < kIterations; ++i) {
      const Sum sum = around(place, kReach);
      if (sum.weight <= 0) return place;
      const Place step{sum.step.angle / sum.weight, sum.step.distance / sum.weight};
      place = wrapped({place.angle + step.angle, place.distance + step.distance});
      if (std::hypot(step.angle, step.distance) < kStill) break;
    }
    return place;
  }

  double votes_m(const Place& place) const { return around(place, kSupportReach).votes; }

  bool same(const Place& a, const Place& b) const {
    const Place other = nearest(a, b);
    return std::abs(other.angle - a.angle) < kSame * std::max(1.0, sigma_.angle) &&
           std::abs(other.distance - a.distance) < kSame * std::max(1.0, sigma_.distance);
  }

 private:
  double at(std::ptrdiff_t angle, std::ptrdiff_t distance) const {
    if (angle < 0 || angle >= angles_) {  // half a turn on the normal points the other way
      angle += angle < 0 ? angles_ : -angles_;
      distance = distances_of_half_turn() - distance;
    }
    if (distance < 0 || distance >= distances_) return 0;
    const auto d = static_cast<std::size_t>(distance);
    return votes_.highest_m(static_cast<std::size_t>(angle), d, d + 1);
  }

  /// Bins d and this minus d are as far from the centre, on opposite sides.
  std::ptrdiff_t distances_of_half_turn() const {
    return std::lround(-2 * votes_.distance0() / votes_.distance_step()) - 1;
  }

  bool is_summit(std::ptrdiff_t a, std::ptrdiff_t d) const {
    const double here = at(a, d);
    if (here <= 0) return false;
    for (std::ptrdiff_t da = -1; da <= 1; ++da) {
      for (std::ptrdiff_t dd = -1; dd <= 1; ++dd) {
        if (at(a + da, d + dd) > here) return false;
      }
    }
    return true;
  }

  Place wrapped(Place place) const {
    const auto n = static_cast<double>(angles_);
    if (place.angle >= -0.5 && place.angle < n - 0.5) return place;
    return {place.angle + (place.angle < 0 ? n : -n),
            static_cast<double>(distances_of_half_turn()) - place.distance};
  }

  /// `b` or its other name half a turn on, whichever is nearer to `a` in angle.
  Place nearest(const Place& a, Place b) const {
    const auto n = static_cast<double>(angles_);
    if (std::abs(b.angle - a.angle) <= n / 2) return b;
    return {b.angle + (b.angle < a.angle ? n : -n),
            static_cast<double>(distances_of_half_turn()) - b.distance};
  }

  Sum around(const Place& place, double reach) const {
    Sum sum;
    const auto first = [&](double middle, double sigma) {
      return static_cast<std::ptrdiff_t>(std::ceil(middle - reach * sigma));
    };
    const auto last = [&](double middle, double sigma) {
      return static_cast<std::ptrdiff_t>(std::floor(middle + reach * sigma));
    };
    for (auto a = first(place.angle, sigma_.angle); a <= last(place.angle, sigma_.angle); ++a) {
      const double da = static_cast<double>(a) - place.angle;
      for (auto d = first(place.distance, sigma_.distance); d <= last(place.distance, sigma_.distance); ++d) {
        const double dd = static_cast<double>(d) - place.distance;
        const double r2 =
            da * da / (sigma_.angle * sigma_.angle) + dd * dd / (sigma_.distance * sigma_.distance);
        const double votes = r2 <= reach * reach ? at(a, d) : 0;
        if (votes <= 0) continue;
        const double weight = votes * std::exp(-0.5 * r2);
        sum.votes += votes;
        sum.weight += weight;
        sum.step.angle += weight * da;
        sum.step.distance += weight * dd;
      }
    }
    return sum;
  }

  const HoughAccumulator& votes_;
  std::ptrdiff_t angles_, distances_;
  Place sigma_;  ///< in bins
};

}  // namespace

std::vector<HoughMode> hough_modes(const HoughAccumulator& votes, const Bandwidth& bandwidth,
                                   double min_votes_m) {
  const MeanShift shift(votes, bandwidth);
  std::vector<Place> places;
  std::vector<HoughMode> modes;
  for (const Place& start : shift.starts()) {
    const Place place = shift.climb(start);
    const double votes_m = shift.votes_m(place);
    if (votes_m < min_votes_m) continue;
    if (std::any_of(places.begin(), places.end(), [&](const Place& p) { return shift.same(p, place); })) {
      continue;
    }
    places.push_back(place);
    modes.push_back({votes.line_at(place.angle, place.distance), votes_m});
  }
  std::sort(modes.begin(), modes.end(), [](const HoughMode& a, const HoughMode& b) {
    return std::make_tuple(-a.votes_m, a.line.theta, a.line.d) <
           std::make_tuple(-b.votes_m, b.line.theta, b.line.d);
  });
  return modes;
}

}  // namespace roomcut::detect_lines
