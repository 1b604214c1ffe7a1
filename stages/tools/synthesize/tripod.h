// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "common/mesh/mesh_tree.h"
#include "stages/tools/synthesize/handheld.h"
#include "stages/tools/synthesize/holes.h"
#include "stages/tools/synthesize/random_draws.h"
#include "stages/tools/synthesize/sample.h"

namespace roomcut::synthesize {

/// Points as a terrestrial scanner takes them: from every station columns of equal angular steps, in scan
/// order (station, azimuth, elevation), range noise along the beam. What a beam meets beyond a window is
/// lost.
class TripodSource : public PointSource {
 public:
  TripodSource(const Scene& scene, const Building& building, const Surfaces& surfaces);
  std::uint64_t blocks() const override {
    return copies(scene_) * building_.stations.size() * blocks_per_station_;
  }
  std::uint64_t expected_points() const override { return expected_; }
  SetUp set_up(std::uint64_t block) const override;
  void make(std::uint64_t block, std::vector<float>& xyz) const override;
  double angular_step() const { return step_; }  ///< [rad]

 private:
  void set_step(double step);
  double return_share() const;
  std::optional<Vec3> measure(const Vec3& station, double column, double row, PointDraws& draws) const;
  std::optional<double> through_window(const WallOpening& window, const Vec3& p, const Vec3& direction) const;

  const Scene& scene_;
  const Building& building_;
  const Surfaces& surfaces_;
  MeshTree tree_;
  Holes holes_;
  Handheld handheld_;
  double step_ = 0;
  std::uint64_t columns_ = 0, rows_ = 0, blocks_per_station_ = 0, columns_per_block_ = 0, expected_ = 0;
};

}  // namespace roomcut::synthesize
