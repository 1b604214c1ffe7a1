// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

#include "common/cloud/cloud.h"

namespace roomcut::ingest {

/// Area of surface across each axis: planes whose normal lies within 5° of x or y, and level ones for z.
class AxisAreas {
 public:
  void add(const CloudTile& part);
  const std::array<double, 3>& m2() const { return m2_; }

 private:
  std::array<double, 3> m2_{0, 0, 0};
};

/// Whether the floors seem to stand upright: along x or y the scan is clearly lower than along the other two
/// axes, and there is more than twice as much surface across it than there are level planes. Returns the
/// question for the user, with the evidence and the option; "" when there is none. `low`, `high`: the scan's
/// box, as it was read with up axis `up`.
std::string upright_floors(const AxisAreas& areas, const Vec3& low, const Vec3& high, const std::string& up);

}  // namespace roomcut::ingest
