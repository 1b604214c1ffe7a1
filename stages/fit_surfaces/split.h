// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "stages/fit_surfaces/regions.h"

namespace roomcut::fit_surfaces {

/// Samples of level faces: those of level face i are samples[first[i] … first[i + 1]).
struct FaceSamples {
  std::vector<Sample> samples;
  std::vector<std::size_t> first;

  std::span<const Sample> of(std::size_t level_face) const {
    return std::span(samples).subspan(first[level_face], first[level_face + 1] - first[level_face]);
  }
  std::vector<Sample> of_all(const std::vector<std::size_t>& level_faces) const;
};

/// The parts of a level region that lie at heights of their own, each over whole faces of the plan; again as
/// long as there are two in one. Faces that don't tell join the part that they border on most. A carpet,
/// whose rim crosses faces, splits nothing.
std::vector<Region> split_by_height(const CellComplex& complex, const FaceSamples& samples, Region region);

/// Middle of a region's faces, by area, and that area [m²].
Vec2 middle_of(const CellComplex& complex, const Region& region);
double area_of(const CellComplex& complex, const Region& region);

}  // namespace roomcut::fit_surfaces
