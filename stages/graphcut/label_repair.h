// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/manifold_check.h"
#include "stages/graphcut/energy.h"

namespace roomcut::graphcut {

struct Repair {
  std::vector<std::uint8_t> label;
  std::int64_t flips = 0;  ///< cells whose label differs from the one given
  double added_m3 = 0;     ///< energy that the repair cost; not negative after an optimal cut
};

/// Changes labels until the surface is a 2-manifold everywhere, cheapest changes first. Two phases, both
/// finite:
///  1. flips in either direction that leave fewer bad places than before: their number falls with every flip;
///  2. for what is left, flips in one direction only, at cells around bad places: from empty to solid, which
///  ends at the
///     latest when all is solid, or from solid to empty, which ends at the latest when the whole box is
///     empty. Both are tried; the cheaper result is taken, the solid one when equal.
/// Ties go by cell index: deterministic.
Repair repair_labels(const ManifoldCheck& check, const EnergyTerms& terms,
                     const std::vector<std::uint8_t>& label);

}  // namespace roomcut::graphcut
