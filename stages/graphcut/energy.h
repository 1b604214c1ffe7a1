// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/graphcut/params.h"

namespace roomcut::graphcut {

/// The energy of paper §2 as a sum of capacities on the faces and cells of the complex, in m^3:
///   E = sum over cells of D(label) + mu * sum over faces of unseen(omega) * (1 - implied) * area * [labels
///   differ],
/// unseen = 1 - omega / free_from, not below 0: where 30 % of a face was seen, the rest hides behind
/// furniture, or is a window, a door or a shadow; with free_from = 1 it is the paper's 1 - omega, which gives
/// up walls behind furniture, and glazed ones. Beyond the bounding box all is solid. Every term is rounded to
/// kQuantum, so that sums of terms are exact in double (up to 8e6 m^3): the minimum does not depend on the
/// order of summation, and the cut's flow equals its energy.
struct EnergyTerms {
  static constexpr double kQuantum_m3 = 0x1.0p-30;  ///< about 1 mm^3

  std::vector<double> d_empty, d_solid;  ///< per cell [m^3]
  std::vector<double> wall, level;       ///< per wall face and level face: cost when its sides differ [m^3]
};

/// A term as EnergyTerms holds it, rounded to kQuantum.
double quantised(double value_m3);

/// Throws std::logic_error when weights or terms do not fit the complex.
EnergyTerms energy_terms(const CellComplex& complex, const FaceWeights& weights, const DataTerms& terms,
                         const GraphcutParams& params);

struct Energy {
  double data_m3 = 0, boundary_m3 = 0;
  double total_m3() const { return data_m3 + boundary_m3; }
};

/// The energy of a labelling; exact.
Energy energy_of(const CellComplex& complex, const EnergyTerms& terms,
                 const std::vector<std::uint8_t>& label);

/// How much the energy grows when one cell changes its label and all others keep theirs [m^3]. O(corners of
/// the cell).
double flip_cost(const CellComplex& complex, const EnergyTerms& terms, const std::vector<std::uint8_t>& label,
                 std::size_t cell);

}  // namespace roomcut::graphcut
