// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/line2.h"

namespace roomcut {

/// A planar subdivision of a rectangle into convex faces, as half-edges: half-edge h and its twin h ^ 1 are
/// the two sides of one edge, each with the face on its left counter-clockwise; kOutside is beyond the
/// rectangle. It begins with one face or several, the original ones, and only ever changes by splitting an
/// edge, which both its faces see at once, and by splitting a face along a chord between two of its corners:
/// so it is conforming whatever the coordinates are.
class Subdivision {
 public:
  static constexpr std::int32_t kOutside = -1;
  static constexpr std::int32_t kNoLine = -1;
  static constexpr std::int32_t kRemoved = -2;  ///< face of a half-edge that is no longer there

  struct HalfEdge {
    std::int32_t origin;      ///< vertex it leaves
    std::int32_t next, prev;  ///< along its face
    std::int32_t face;        ///< to its left
    std::int32_t line;  ///< that the edge lies on; kNoLine = side of the rectangle. Equal for both twins.
  };

  /// The rectangle as one face.
  Subdivision(const Vec2& low, const Vec2& high);
  /// A subdivision that there is already, of a rectangle into convex faces: as the members of these names.
  Subdivision(std::vector<Vec2> vertices, std::vector<HalfEdge> half_edges,
              std::vector<std::int32_t> face_start);

  std::vector<Vec2> vertices;
  std::vector<HalfEdge> half_edges;
  std::vector<std::int32_t> face_start;  ///< a half-edge of every face; kRemoved = merged into another
  std::vector<std::int32_t> original;    ///< per face, the original face that it was split from

  std::int32_t twin(std::int32_t h) const { return h ^ 1; }
  std::int32_t target(std::int32_t h) const { return half_edges[h ^ 1].origin; }
  const Vec2& from(std::int32_t h) const { return vertices[half_edges[h].origin]; }
  const Vec2& low() const { return low_; }    ///< lower left corner of the rectangle
  const Vec2& high() const { return high_; }  ///< upper right corner

  /// Puts a vertex at p, which must lie on the edge, into it. Returns the half-edge that leaves the new
  /// vertex along h.
  std::int32_t split_edge(std::int32_t h, const Vec2& p);

  /// Splits the face of h and g from origin(h) to origin(g) with an edge on `line`, whose Hesse form is
  /// `geometry`; the corners after h must lie on its negative side. The new face's index is face_start.size()
  /// - 1.
  void split_face(std::int32_t h, std::int32_t g, std::int32_t line, const Line2& geometry);

  /// The face that contains p, which must lie in the original face `within`; next to an edge it may be the
  /// face beyond (off by no more than chords are from their lines). Descends the tree of splits: about 2
  /// ln(faces) steps in random order.
  std::int32_t locate(const Vec2& p, std::int32_t within = 0) const;

  /// Takes an edge away: the faces on its two sides become one, that of h. They must differ, and neither end
  /// of the edge may be left with a single edge. An end that is left with two edges on one line is dissolved:
  /// they become one edge. locate() must not be called afterwards.
  void remove_edge(std::int32_t h);
  bool is_removed(std::int32_t h) const { return half_edges[h].face == kRemoved; }

  /// Faces in the order of the trees of splits: neighbours in space are near in this order, the parts of an
  /// original face side by side.
  std::vector<std::int32_t> faces_in_tree_order() const;

 private:
  struct Split {
    Vec2 normal;
    double d;
    std::int32_t below, above;  ///< on the negative and positive side: a split, or ~face
  };
  std::vector<Split> splits_;
  std::vector<std::int32_t> root_;  ///< original face -> a split, or ~face
  std::vector<std::int32_t> slot_;  ///< face -> 2 * split + (0 below, 1 above), or ~(index into root_)
  Vec2 low_, high_;

  std::int32_t& node(std::int32_t slot);
  void link(std::int32_t before, std::int32_t after);
  void dissolve_end(std::int32_t h);
};

}  // namespace roomcut
