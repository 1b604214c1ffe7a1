// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/line2.h"

namespace roomcut::detect_lines {

/// Votes for wall lines over angle and signed distance to a centre (paper §2), for all wall slices together.
/// Whole numbers, so that votes can be taken back exactly and their order does not matter.
class HoughAccumulator {
 public:
  /// Covers all lines that pass within `radius_m` of `centre`; steps [rad], [m].
  HoughAccumulator(const Vec2& centre, double radius_m, double angle_step, double distance_step);

  /// Adds (sign +1) or takes back (-1) the votes of a piece of wall at p: `weight_m` for every angle within
  /// `window` of theta, and half of it in the neighbouring distances. A single angle would not do: an error
  /// of the local angle times the lever arm to the centre is soon a wall's thickness.
  void vote(const Vec2& p, double theta, double window, double weight_m, int sign);

  struct Peak {
    Line2 line;
    double votes_m = 0;  ///< [m]
    std::size_t angle = 0, distance = 0;
  };
  /// The highest bin; the first in (angle, distance) among equals.
  Peak peak();
  /// Keeps a bin from ever being a peak again.
  void suppress(const Peak& peak);

  /// The line at a place between bins (whole numbers: their middles), as peaks are given.
  Line2 line_at(double angle, double distance) const;

  std::size_t angles() const { return angles_; }
  std::size_t distances() const { return distances_; }
  double angle_step() const { return angle_step_; }
  double distance_step() const { return distance_step_; }
  double distance0() const {
    return -radius_;
  }  ///< lower edge of the first distance bin, from the centre [m]
  /// The highest of the distances [begin, end), which must not be empty [m].
  double highest_m(std::size_t angle, std::size_t begin, std::size_t end) const;

 private:
  /// The highest bin of a part of a row; looked for again only where votes changed.
  struct Best {
    std::int32_t votes = 0;
    std::uint32_t distance = 0;
    bool stale = true;
  };
  void changed(std::size_t angle, std::size_t bin, bool more);
  void find_best(std::size_t angle);
  Vec2 centre_;
  double radius_;
  double angle_step_, distance_step_;
  std::size_t angles_, distances_;
  std::size_t blocks_;  ///< per row
  std::vector<Vec2> normals_;
  std::vector<std::int32_t> votes_;  ///< row-major: angle, distance
  std::vector<Best> best_;           ///< per angle
  std::vector<Best> block_best_;  ///< row-major: angle, block of distances; a row is long in a large building
};

}  // namespace roomcut::detect_lines
