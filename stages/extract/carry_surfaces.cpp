// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/carry_surfaces.h"

#include <algorithm>
#include <utility>

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

/// What a level face bounds: -1 nothing, 0 a floor, 1 a ceiling.
int side_of(const CellComplex& complex, const std::vector<std::uint8_t>& label, std::size_t level_face) {
  const std::size_t level = complex.level_of(level_face);
  const bool below = level > 0 && is_empty(label, level_face - complex.faces());
  const bool above = level < complex.layers() && is_empty(label, level_face);
  return above == below ? -1 : below ? 1 : 0;
}

/// The sloped surface beside a face on a step's level; -1 = none.
std::int32_t plane_beside(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                          const LevelSurfaces& surfaces, std::size_t face, std::size_t level) {
  const int side = side_of(complex, label, complex.level_face(face, level));
  const Vec2 middle = complex.centroid(face);
  std::int32_t best = -1;
  double longest = 0;
  for (const std::int32_t e : complex.edges_of(face)) {
    const std::int32_t other =
        complex.edges[static_cast<std::size_t>(e)].across(static_cast<std::int32_t>(face));
    for (std::size_t l = level - 1; other >= 0 && l <= level + 1; ++l) {
      const std::size_t beside = complex.level_face(static_cast<std::size_t>(other), l);
      const std::int32_t surface = surfaces.of_face[beside];
      if (surface < 0 || side_of(complex, label, beside) != side) continue;
      const LevelSurface& plane = surfaces.surfaces[static_cast<std::size_t>(surface)];
      const double z = plane.height(middle);
      constexpr double kMargin_m = 1e-3;
      if (!plane.gradient.isZero(0) && z > complex.levels[level - 1] - kMargin_m &&
          z < complex.levels[level + 1] + kMargin_m &&
          complex.length(static_cast<std::size_t>(e)) > longest) {
        longest = complex.length(static_cast<std::size_t>(e));
        best = surface;
      }
    }
  }
  return best;
}

}  // namespace

void follow_planes(const CellComplex& complex, const std::vector<std::uint8_t>& label,
                   LevelSurfaces& surfaces) {
  if (surfaces.of_face.empty() || complex.steps.empty()) {
    return;
  }
  std::vector<std::int32_t> of_face = surfaces.of_face;
  for (std::size_t level = 1; level + 1 < complex.levels.size(); ++level) {
    for (std::size_t face = 0; complex.steps[level] != 0 && face < complex.faces(); ++face) {
      const std::size_t at = complex.level_face(face, level);
      if (of_face[at] < 0 && side_of(complex, label, at) >= 0) {
        of_face[at] = plane_beside(complex, label, surfaces, face, level);
      }
    }
  }
  surfaces.of_face = std::move(of_face);
}

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
