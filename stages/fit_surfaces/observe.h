// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/cells/face_raster.h"
#include "common/cloud/cloud.h"
#include "stages/fit_surfaces/seats.h"

namespace roomcut::fit_surfaces {

/// Where a seat's surface lies in one patch: a piece of a plan face in one bin of a grid.
struct Observation {
  std::size_t seat = 0;
  Vec2 at{0, 0};           ///< mean place of its points [m]
  double offset_m = 0;     ///< of the surface over its seat, upright
  double variance_m2 = 0;  ///< of offset_m, expected from scatter and number of points
  double scatter_m2 = 0;   ///< mean square distance of its points from it, along the seat's normal
  double area_m2 = 0;      ///< of the plan
  std::uint32_t points = 0;
};

/// Collects in one pass over the points, in any order and by any number of threads (integer sums), the
/// observations of all seats. A point counts for the nearest seat of its plan face within reach: points of
/// horizontal surfaces for any, those of sloped ones for planes. Faces are shrunk by a margin: the foot of a
/// wall is no floor. Memory: one histogram of about 1 kB per patch that holds points.
class SurfaceObserver {
 public:
  /// `seats` and `complex` stay the caller's.
  SurfaceObserver(const CellComplex& complex, const Seats& seats, double patch_m, double reach_m,
                  double noise_m);
  ~SurfaceObserver();
  SurfaceObserver(const SurfaceObserver&) = delete;
  SurfaceObserver& operator=(const SurfaceObserver&) = delete;

  /// Takes in the points of a tile. Thread-safe.
  void add(const CloudTile& tile);
  /// After all points are in: patches with fewer than 4 points near their surface are left out. In the order
  /// of the grid's bins, there of faces and seats.
  std::vector<Observation> observations() const;
  std::uint64_t points() const { return points_.load(); }

 private:
  using Sum = std::atomic<std::uint64_t>;
  Sum* histogram(std::size_t patch);

  const Seats& seats_;
  FaceRaster raster_;
  double reach_m_, noise_m_;
  std::size_t bins_;
  std::vector<std::size_t> first_patch_;  ///< per piece; then one patch for each of its seats
  std::unique_ptr<std::atomic<Sum*>[]> histograms_;
  std::atomic<std::uint64_t> points_{0};
};

}  // namespace roomcut::fit_surfaces
