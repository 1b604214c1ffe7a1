// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::testing {

/// A box of nx x ny x nz cells of 1 m: levels 0 … nz, lines at 1 … nx - 1 and 1 … ny - 1, margins of 1 m
/// inside it.
CellComplex grid_complex(int nx, int ny, int nz);
/// A complex of random lines (some of them nasty) with `layers` layers of 1 to 3 m.
CellComplex random_complex(std::uint64_t seed, int lines, int layers);

FaceWeights random_weights(const CellComplex& complex, std::uint64_t seed);
DataTerms random_terms(const CellComplex& complex, std::uint64_t seed);
/// All faces uncovered, all cells undecided.
FaceWeights no_weights(const CellComplex& complex);
DataTerms terms_of(const CellComplex& complex, const std::vector<float>& beta);
std::vector<std::uint8_t> random_labels(const CellComplex& complex, std::uint64_t seed, double share_empty);

}  // namespace roomcut::testing
