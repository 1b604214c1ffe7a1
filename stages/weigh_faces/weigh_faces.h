// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "common/cells/cell_complex.h"
#include "common/cloud/cloud.h"
#include "stages/weigh_faces/params.h"
#include "stages/weigh_faces/tolerances.h"

namespace roomcut::weigh_faces {

/// Weighs the faces of a cell complex by one pass over the cloud (paper §2, regularisation term; see
/// README.md). Memory grows with the surface, not with the points. Same points, same result, in any order and
/// with any number of threads.
class FaceWeigher {
 public:
  /// `complex` must outlive the weigher and have at least one layer. Only noise and density of `cloud` are
  /// used.
  FaceWeigher(const CellComplex& complex, const CloudHeader& cloud, const WeighFacesParams& params);
  ~FaceWeigher();

  /// Takes in the points of a tile. Thread-safe.
  void add(const CloudTile& tile);
  /// The weights, after all points are in.
  FaceWeights weigh() const;

  const Tolerances& tolerances() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roomcut::weigh_faces
