// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "stages/ingest/scan_frame.h"

namespace roomcut::ingest {

/// The coordinates mixed into one number; that two others give the same is not to be expected in any scan.
/// Equal are coordinates that are so as local float32, within 0.1 mm.
std::uint64_t key_of_point(float x, float y, float z);

/// How many points of a scan repeat another one's coordinates, from the same few thousand of all coordinates
/// wherever in the file they stand. One for each thread. What it says does not depend on the order of the
/// points, nor on how they were spread over threads.
class DuplicateSample {
 public:
  void add(const LocalPoints& points);
  void add(const DuplicateSample& other);
  /// Of the points, those without whom all coordinates would be distinct; 0 without points.
  double share() const;

 private:
  void thin();
  std::vector<std::uint64_t> keys_;
  std::uint64_t mask_ = 0;  ///< a key is taken when these bits are 0
};

}  // namespace roomcut::ingest
