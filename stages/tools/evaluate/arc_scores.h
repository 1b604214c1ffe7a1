// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "common/geometry/line2.h"

namespace roomcut::evaluate {

/// A curved wall: a part of an upright cylinder, of the truth or of the model.
struct DescribedArc {
  Vec2 centre{0, 0};
  double radius_m = 0;
  double from = 0, sweep = 0;  ///< azimuth of its beginning, and how far it goes on, counter-clockwise [rad]
  double z0 = 0, z1 = 0;
};

struct ArcScores {
  struct Arc {
    double radius_m = 0;  ///< of the truth
    bool found = false;
    double radius_error_m = 0, centre_error_m = 0;  ///< when found
    bool close() const;                             ///< found, radius within max(5 mm, 0.2 %)
  };
  std::vector<Arc> arcs;
  std::size_t false_arcs =
      0;  ///< of the model: they are none of the truth's, or one that has another already
  std::size_t found() const;
  std::size_t close() const;
  std::optional<double> precision() const, recall() const, f1() const;  ///< none where nothing is to be found
};

/// An arc of the truth is found when an arc of the model at its height lies within 3 cm of it over 60 % of
/// its length; each arc of the model is at most one of the truth's, the one that it follows farthest.
ArcScores score_arcs(const std::vector<DescribedArc>& truth, const std::vector<DescribedArc>& model);

}  // namespace roomcut::evaluate
