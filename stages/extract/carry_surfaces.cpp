// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/carry_surfaces.h"

#include <algorithm>

namespace roomcut::extract {

namespace {

/// The surfaces of the level faces that the old complex had.
std::vector<std::int32_t> of_parts(const CellComplex& old, const LevelSurfaces& surfaces,
                                   const OpenableComplex& cut) {
  const CellComplex& complex = cut.complex;
  std::vector<std::int32_t> of_face;
  of_face.reserve(complex.levels.size() * complex.faces());
  for (const double z : complex.levels) {
    const auto level = std::lower_bound(old.levels.begin(), old.levels.end(), z);
    const bool was_there = level != old.levels.end() && *level == z;
    for (std::size_t face = 0; face < complex.faces(); ++face) {
      const std::size_t parent = old.face_of(cut.whole[complex.cell(face, 0)]);
      of_face.push_back(
          was_there
              ? surfaces.of_face[old.level_face(parent, static_cast<std::size_t>(level - old.levels.begin()))]
              : -1);
    }
  }
  return of_face;
}

/// The surface of the floor that an empty cell stands on; -1 = none, or it hangs in the air.
std::int32_t floor_under(const OpenableComplex& cut, const std::vector<std::int32_t>& of_face,
                         std::size_t cell) {
  const CellComplex& complex = cut.complex;
  const std::size_t layer = complex.layer_of(cell);
  const bool stands = layer == 0 || !is_empty(cut.labels.label, cell - complex.faces());
  return stands ? of_face[complex.level_face(complex.face_of(cell), layer)] : -1;
}

}  // namespace

LevelSurfaces carry_surfaces(const CellComplex& complex, const LevelSurfaces& surfaces,
                             const OpenableComplex& cut) {
  if (surfaces.of_face.empty()) {
    return {};
  }
  LevelSurfaces carried{surfaces.surfaces, of_parts(complex, surfaces, cut)};
  const std::size_t faces = cut.complex.faces();
  for (const Passage& passage : cut.passages) {
    const std::int32_t a = floor_under(cut, carried.of_face, passage.cell_a);
    const std::int32_t floor = a >= 0 ? a : floor_under(cut, carried.of_face, passage.cell_b);
    const auto [sill, head] = std::minmax_element(passage.cells.begin(), passage.cells.end());
    const std::size_t lowest = cut.complex.layer_of(*sill);
    const std::size_t highest = cut.complex.layer_of(*head);
    for (const std::size_t cell : passage.cells) {
      std::int32_t& own = carried.of_face[cell];  // of the level face below it, which has its number
      if (cut.complex.layer_of(cell) == lowest && own < 0) {
        own = floor;
      }
      if (cut.complex.layer_of(cell) == highest) {
        carried.of_face[cell + faces] = -1;
      }
    }
  }
  return carried;
}

}  // namespace roomcut::extract
