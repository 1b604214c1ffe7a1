// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/sloped_planes/accepted_planes.h"

namespace roomcut::accept_planes {

/// The planes and levels that `slice` found, in normal form: p0001 … in its order, the largest first.
AcceptedPlanes detected_planes(const Slices& slices);

/// What goes on to the partition, and what the user did to it.
struct Acceptance {
  AcceptedPlanes planes;  ///< the edit's planes if there is an edit, else the detected ones, and their levels
  int kept = 0, edited = 0, added = 0, deleted = 0, locked = 0;
  bool base_moved = false;   ///< the edit began from another detection than today's
  bool steps_moved = false;  ///< the levels are others than slice's: wall slices are counted anew
};

/// Accepts the edit if there is one, otherwise the detection. The levels follow: steps of the accepted
/// planes, as slice makes them (common/slices/plane_steps.h). `detection_sha256` is the payload digest of
/// detected_planes(slices); the result carries that of the detection that its planes began from.
Acceptance accept_planes(const Slices& slices, const AcceptedPlanes& detected,
                         const std::string& detection_sha256, const std::optional<AcceptedPlanes>& edit);

}  // namespace roomcut::accept_planes
