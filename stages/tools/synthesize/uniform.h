// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stages/tools/synthesize/handheld.h"
#include "stages/tools/synthesize/holes.h"
#include "stages/tools/synthesize/random_draws.h"
#include "stages/tools/synthesize/sample.h"

namespace roomcut::synthesize {

/// Points spread evenly over all visible surface: the i-th point lies in the i-th of equal parts of the area.
class UniformSource : public PointSource {
 public:
  UniformSource(const Scene& scene, const Building& building, const Surfaces& surfaces);
  std::uint64_t blocks() const override;
  std::uint64_t expected_points() const override { return points_; }
  SetUp set_up(std::uint64_t /*block*/) const override { return {}; }
  void make(std::uint64_t block, std::vector<float>& xyz) const override;

 private:
  Vec3 point(std::uint64_t i) const;
  Vec3 surface_point(double share, PointDraws& draws) const;
  std::uint64_t shuffled(std::uint64_t i) const;

  const Scene& scene_;
  const Building& building_;
  const Surfaces& surfaces_;
  AreaTable areas_;
  Holes holes_;
  Handheld handheld_;
  std::uint64_t points_;
};

}  // namespace roomcut::synthesize
