// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::fit_surfaces {

/// What may truly stand at a level face of the surface: the level, or a sloped plane.
struct Seat {
  std::int32_t level = 0;
  std::int32_t plane = -1;  ///< of the complex; -1 = the level
  bool ceiling = false;     ///< empty below
  Vec2 gradient{0, 0};      ///< of what may stand there: height gradient · p + c
  double c = 0;
  double cosine = 1;  ///< distance from it = cosine · difference of heights

  double height(const Vec2& p) const { return gradient.dot(p) + c; }
};

/// The seats of all level faces at which the labelling has a surface, by plan face, there by level from
/// below. A face of a step level has the planes that run through it (the level too where there is none), one
/// of another level has the level and those planes that come nearer to it than to the next levels.
class Seats {
 public:
  /// `label` per cell.
  Seats(const CellComplex& complex, const std::vector<std::uint8_t>& label);

  std::size_t size() const { return seats_.size(); }
  const Seat& operator[](std::size_t i) const { return seats_[i]; }
  /// Seats of plan face f: [first(f), first(f + 1)).
  std::size_t first(std::size_t face) const { return first_[face]; }
  std::span<const Seat> of_face(std::size_t face) const {
    return std::span(seats_).subspan(first_[face], first_[face + 1] - first_[face]);
  }

 private:
  void add(const CellComplex& complex, std::size_t face, std::size_t level, bool ceiling);

  std::vector<Seat> seats_;
  std::vector<std::size_t> first_;
};

}  // namespace roomcut::fit_surfaces
