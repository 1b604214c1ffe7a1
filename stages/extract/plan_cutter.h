// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::extract {

/// Cuts short lines into the plan of a cell complex. Edges are split where both their faces see it and faces
/// along chords between two of their corners, so the plan stays conforming and its faces convex.
class PlanCutter {
 public:
  explicit PlanCutter(const CellComplex& complex);

  /// Cuts the faces that the line's part t in [t0, t1] enters, each along its whole chord, beginning with the
  /// face that contains the middle. t0 and t1 should be where the line meets edges: then nothing beyond them
  /// is cut. Corners within kPlanSnap_m of the line count as on it; a chord that would leave a thinner part
  /// is not cut: there the face's own side stands for it. The line is added to the complex under `id`.
  void cut(const Line2& line, double t0, double t1, const std::string& id);

  /// The face that contains p, -1 = none; on an edge, either of its faces.
  std::int32_t locate(const Vec2& p) const;

  /// The complex with the cuts made so far; levels, frame and the old lines as before. `parent`: per face,
  /// the face of the old complex that it is a part of.
  CellComplex result(std::vector<std::int32_t>& parent) const;

 private:
  struct Corner {
    std::int32_t vertex, edge;  ///< the edge from this corner to the next
  };
  struct Chord {
    std::int32_t from = -1, to = -1;  ///< vertices; -1 = none
  };

  std::int32_t split_edge(std::int32_t edge, const Vec2& p);
  Chord chord_of(std::int32_t face, const Line2& line);
  void split_face(std::int32_t face, const Chord& chord, std::int32_t line);
  bool worth_a_split(std::int32_t face, const Chord& chord) const;
  std::vector<std::int32_t> faces_at(std::int32_t vertex) const;

  CellComplex complex_;
  std::vector<std::vector<Corner>> loops_;  ///< per face, counter-clockwise
  std::vector<std::int32_t> parent_;
};

}  // namespace roomcut::extract
