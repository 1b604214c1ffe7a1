// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/cloud/azimuth_set.h"
#include "stages/refine_lines/line_faces.h"

namespace roomcut::refine_lines {

/// Where the observations of one line are collected.
struct LineTrack {
  std::size_t line;                 ///< index into the lines
  std::vector<std::int32_t> patch;  ///< bins × zones; index among all patches, -1 = no surface
  AzimuthSet fits;                  ///< azimuths of wall points that may lie on it
};

/// A line, prepared for the loop over points.
struct NearLine {
  const LineTrack* track;
  const LineFaces* faces;
  Vec2 normal, direction;
};

/// Which lines pass near each block of half a metre of a tile: a point then asks one or two instead of the
/// dozens that cross the tile.
class LineNeighbourhood {
 public:
  /// Lines count as far as `band_m` from them and between their ends. `lines` must be in the order in which a
  /// point is to ask them.
  LineNeighbourhood(const CloudTile& tile, const std::vector<NearLine>& lines, double band_m);

  bool empty() const { return near_.empty(); }
  /// Those near a point of the tile, in their order.
  std::span<const NearLine> near(float x, float y) const {
    const auto column = static_cast<std::size_t>((x - low_.x()) / kBlock_m);
    const auto row = static_cast<std::size_t>((y - low_.y()) / kBlock_m);
    const std::size_t block = row * columns_ + column;
    const std::size_t first = block == 0 ? 0 : end_[block - 1];
    return {near_.data() + first, end_[block] - first};
  }

 private:
  static constexpr double kBlock_m = 0.5;
  Vec2 low_{0, 0};
  std::size_t columns_ = 0;
  std::vector<NearLine> near_;    ///< block by block
  std::vector<std::size_t> end_;  ///< of each block's in near_
};

}  // namespace roomcut::refine_lines
