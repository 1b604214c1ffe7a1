// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/plan_grid.h"

namespace roomcut {

/// The plan's faces cut into the bins of a grid, exactly: one piece per (bin, face) that meet, with its area.
/// Faces are shrunk by a margin first (thin faces by at most a fifth of their width), so that the noise of a
/// wall's points or the rim of the neighbour's floor does not spill into them: a strip of 10 cm inside a wall
/// keeps its own coverage.
class FaceRaster {
 public:
  struct Piece {
    std::int32_t face;
    float area;  ///< of the shrunk face inside the bin [m²]
  };

  FaceRaster(const CellComplex& complex, double bin, double margin);

  const PlanGrid& grid() const { return grid_; }
  std::size_t pieces() const { return pieces_.size(); }
  const Piece& piece(std::size_t index) const { return pieces_[index]; }
  /// Pieces of bin b: [first(b), first(b + 1)).
  std::size_t first(std::size_t bin) const { return first_[bin]; }
  /// The piece that holds p, or -1 (outside, or within the margin of a side).
  std::int64_t find(const Vec2& p) const;

 private:
  struct HalfPlane {
    double nx, ny, d;  ///< inside: nx x + ny y <= d
  };
  using Polygon = std::vector<Vec2>;

  Polygon shrink(const CellComplex& complex, std::size_t face, double margin);
  void cut_into_bins(const Polygon& polygon, std::int32_t face,
                     std::vector<std::pair<std::size_t, Piece>>& out) const;

  PlanGrid grid_;
  std::vector<Piece> pieces_;  // by bin, then face
  std::vector<std::uint32_t> first_;
  std::vector<std::int64_t> side_offset_;
  std::vector<HalfPlane> sides_;  // of the shrunk faces
};

}  // namespace roomcut
