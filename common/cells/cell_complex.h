// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "common/artefact/provenance.h"
#include "common/cells/surface_decision.h"
#include "common/geometry/line2.h"
#include "common/geometry/sloped_plane.h"

namespace roomcut {

/// The one tolerance of the plan: a vertex within it of a line lies on that line, and no wall face is
/// narrower. Lines are stored with 6 decimals, so lines meant to meet in one point miss it by some 1e-6 m;
/// nothing measurable is this small.
inline constexpr double kPlanSnap_m = 1e-5;

/// The corners of one face of a plan, counter-clockwise: a range of places [m]. Valid as long as the complex.
class FaceCorners {
 public:
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = Vec2;
    using difference_type = std::ptrdiff_t;
    using pointer = const Vec2*;
    using reference = const Vec2&;

    Iterator() = default;
    Iterator(const Vec2* places, const std::int32_t* vertex) : places_(places), vertex_(vertex) {}
    reference operator*() const { return places_[*vertex_]; }
    pointer operator->() const { return places_ + *vertex_; }
    Iterator& operator++() {
      ++vertex_;
      return *this;
    }
    Iterator operator++(int) { return {places_, vertex_++}; }
    bool operator==(const Iterator& other) const { return vertex_ == other.vertex_; }

   private:
    const Vec2* places_ = nullptr;
    const std::int32_t* vertex_ = nullptr;
  };

  FaceCorners(const Vec2* places, std::span<const std::int32_t> vertices)
      : places_(places), vertices_(vertices) {}
  std::size_t size() const { return vertices_.size(); }
  const Vec2& operator[](std::size_t i) const { return places_[vertices_[i]]; }
  /// The corner that follows corner i: the other end of the side that begins there.
  const Vec2& after(std::size_t i) const { return (*this)[i + 1 < size() ? i + 1 : 0]; }
  Iterator begin() const { return {places_, vertices_.data()}; }
  Iterator end() const { return {places_, vertices_.data() + size()}; }

 private:
  const Vec2* places_;
  std::span<const std::int32_t> vertices_;
};

/// The cell decomposition (paper §2): one convex subdivision of the plan, the same in every layer, times the
/// layers between neighbouring levels. All 3D elements are implicit products:
///   cell     (face f, layer k)  index k * faces() + f       volume  area(f) * height(k)
///   wall face (edge e, layer k) index k * edges() + e       area    length(e) * height(k)
///   level face (face f, level l) index l * faces() + f      area    area(f)
/// The subdivision is conforming: two faces share whole edges. Faces are convex, counter-clockwise, and may
/// have vertices in the middle of a straight side. The outermost faces end at the bounding box, beyond which
/// all is solid.
struct CellComplex {
  Frame frame;
  std::vector<double> levels;  ///< ascending heights [m]; layers() = levels.size() - 1

  std::vector<Vec2> vertices;  ///< [m]
  std::vector<std::int64_t>
      face_offset;  ///< faces + 1; face f has corners face_vertex[face_offset[f] … face_offset[f+1])
  std::vector<std::int32_t> face_vertex;
  std::vector<std::int32_t> face_edge;  ///< parallel to face_vertex: the edge from this corner to the next

  struct Edge {
    std::int32_t v0, v1;       ///< vertices
    std::int32_t left, right;  ///< faces left and right of v0 -> v1; -1 = beyond the bounding box
    std::int32_t line;         ///< index into lines; -1 = side of the bounding box

    /// The face on the other side than `face`, which must be one of the two.
    std::int32_t across(std::int32_t face) const { return left == face ? right : left; }
  };
  std::vector<Edge> edges;

  struct Line {
    std::string wall_id;
    Line2 line;
    double t0, t1;  ///< support interval along the line [m]
    /// Layers where the line may carry a wall, ascending; empty = all. It cuts the plan of every layer all
    /// the same (one subdivision for all layers), but weigh_faces gives its faces no evidence in other
    /// layers.
    std::vector<std::int32_t> layers;
    /// -1 = a wall line. Else a crease, which carries no wall: where this one of `planes` meets another plane
    /// or a level or, with `layers`, where it passes from one step to the next: they are the riser's.
    std::int32_t plane = -1;

    bool carries(std::size_t layer) const {
      return plane < 0 && (layers.empty() || std::binary_search(layers.begin(), layers.end(),
                                                                static_cast<std::int32_t>(layer)));
    }
    /// Whether the stairs that stand for a sloped plane rise here in this layer.
    bool rises(std::size_t layer) const {
      return plane >= 0 && std::binary_search(layers.begin(), layers.end(), static_cast<std::int32_t>(layer));
    }
  };
  std::vector<Line> lines;
  /// Whether the edge lies on a wall line, neither on a crease nor on a side of the bounding box.
  bool on_wall_line(const Edge& edge) const {
    return edge.line >= 0 && lines[static_cast<std::size_t>(edge.line)].plane < 0;
  }

  /// Sloped floors and ceilings. In the cells they are stairs, one step where the plane is nearest to a level
  /// of `steps`; what follows the cut puts the plane itself in their place (LevelSurfaces).
  std::vector<SlopedPlane> planes;
  std::vector<std::uint8_t> steps;  ///< per level: 1 = stands for sloped planes alone

  std::size_t faces() const { return face_offset.empty() ? 0 : face_offset.size() - 1; }
  std::size_t layers() const { return levels.empty() ? 0 : levels.size() - 1; }
  std::size_t cells() const { return faces() * layers(); }

  std::size_t cell(std::size_t face, std::size_t layer) const { return layer * faces() + face; }
  std::size_t face_of(std::size_t cell) const { return cell % faces(); }
  std::size_t layer_of(std::size_t cell) const { return cell / faces(); }
  std::size_t wall_face(std::size_t edge, std::size_t layer) const { return layer * edges.size() + edge; }
  std::size_t edge_of_wall(std::size_t wall_face) const { return wall_face % edges.size(); }
  std::size_t layer_of_wall(std::size_t wall_face) const { return wall_face / edges.size(); }
  std::size_t level_face(std::size_t face, std::size_t level) const { return level * faces() + face; }
  std::size_t face_of_level(std::size_t level_face) const { return level_face % faces(); }
  std::size_t level_of(std::size_t level_face) const { return level_face / faces(); }

  /// Vertices of a face, counter-clockwise, and its edges, each from the vertex at its place to the next.
  std::span<const std::int32_t> vertices_of(std::size_t face) const { return part_of(face_vertex, face); }
  std::span<const std::int32_t> edges_of(std::size_t face) const { return part_of(face_edge, face); }
  FaceCorners corners(std::size_t face) const { return {vertices.data(), vertices_of(face)}; }

  double height(std::size_t layer) const { return levels[layer + 1] - levels[layer]; }
  double length(std::size_t edge) const {
    return (vertices[edges[edge].v1] - vertices[edges[edge].v0]).norm();
  }
  /// Area of a face [m^2].
  double area(std::size_t face) const;
  /// Mean of a face's corners, weighted by area: always inside.
  Vec2 centroid(std::size_t face) const;
  /// Volume of a cell [m^3].
  double volume(std::size_t cell) const { return area(face_of(cell)) * height(layer_of(cell)); }
  /// The middle of a cell: its face's centroid, at half its height.
  Vec3 centre(std::size_t cell) const;
  /// The layer that holds height z, which begins at its lower level; -1 = below or above all.
  std::int32_t layer_at(double z) const;

 private:
  std::span<const std::int32_t> part_of(const std::vector<std::int32_t>& corners, std::size_t face) const {
    return {corners.data() + face_offset[face], corners.data() + face_offset[face + 1]};
  }
};

/// Checks conformity, orientation, convexity, adjacency, edges against their lines (kPlanSnap_m) and that the
/// faces tile the bounding box. Returns "" or the first violation; linear. Stages call it on what they read
/// and what they write.
std::string find_violation(const CellComplex& complex);

/// Evidence on the faces (paper §2, regularisation term): coverage by points and, where the points beside a
/// surface tell, which side of it is empty. Indices as in CellComplex.
struct FaceWeights {
  std::vector<float> wall_omega;  ///< wall faces: density-corrected covered share, 0 … 1
  /// Share of the coverage that speaks for empty space on the edge's left and right side, 0 … 1.
  std::vector<float> wall_left, wall_right;
  std::vector<std::uint32_t> wall_points;
  std::vector<float> level_omega;    ///< level faces: covered share by any horizontal surface
  std::vector<float> level_floor;    ///< covered share by floor surface (empty above)
  std::vector<float> level_ceiling;  ///< covered share by ceiling surface (empty below)
  std::vector<std::uint32_t> level_points;
  std::vector<std::uint32_t> cell_points;  ///< cells: points strictly inside, away from the cell's faces
  std::vector<float>
      cell_slope;              ///< cells: share of the plan over which a sloped surface (roof) passes through
  std::vector<Vec3> stations;  ///< scanner positions, where the scan names them [m]

  /// Whether a face is a surface, and which side of a wall face is empty: surface_decision.h.
  double wall_probability(std::size_t face) const { return surface_probability(wall_omega[face]); }
  double level_probability(std::size_t face) const { return surface_probability(level_omega[face]); }
  bool is_wall(std::size_t face) const { return is_likely(wall_probability(face)); }
  bool is_surely_wall(std::size_t face) const { return is_sure(wall_probability(face)); }
  bool is_level(std::size_t face) const { return is_likely(level_probability(face)); }
  FaceSide wall_side(std::size_t face) const {
    return clear_side(wall_omega[face], wall_left[face], wall_right[face]);
  }
};

/// A measure of every cell that speaks for empty or against it, and how much.
struct CellFeature {
  std::string name;
  double weight = 0;         ///< log-odds of empty per unit
  std::string meaning;       ///< one sentence
  std::vector<float> value;  ///< per cell
};

/// Evidence and data term per cell (paper §2, data term): beta = sigma(constant + sum of weight * value over
/// the features). Other measures are kept to look at.
struct DataTerms {
  /// Sets all values to 0, as many as the complex has cells and faces; no features.
  void reset(const CellComplex& complex);

  std::vector<CellFeature> features;
  double constant = 0;         ///< log-odds of a cell of which nothing is known
  std::string weights_source;  ///< where constant and weights come from

  std::vector<float> kappa;     ///< share of rays with an odd number of crossings, 0 … 1
  std::vector<float> vertical;  ///< nearest permanent face straight up and down: +1 empty … -1 solid
  std::vector<float> around;    ///< the same along the rays: +1 empty … -1 solid
  /// Mean over the rays of the signed crossings (leaving empty space +, entering it -): 1 inside, 0 outside.
  std::vector<float> winding;
  /// Covered area of the cell's own faces, + where it faces the cell, - where it turns its back [m^2].
  std::vector<float> surface_m2;
  std::vector<float> thin;           ///< 1 = as thin as walls and slabs, 0 = wider than any
  std::vector<float> line_of_sight;  ///< share of the cell that the scanners looked through, where their
                                     ///< positions are known
  std::vector<float> observed;       ///< share of rays that end on a seen face: 0 = nothing is known of it
  std::vector<float> closed;         ///< share of level rays that end on a seen face: 1 = closed all around
  std::vector<float> beta;           ///< probability that the cell is empty, 0 … 1

  /// Share of the rays that end on a face seen from this side: how much of what lies around was seen from
  /// inside, 0 … 1.
  double seen_inside(std::size_t cell) const { return 0.5 * (observed[cell] + around[cell]); }
  /// Faces that must be there though no point lies on them, 0 … 1: the other side of a wall or slab that was
  /// seen from one side only.
  std::vector<float> wall_implied, level_implied;
  std::vector<double>
      d_empty;  ///< cost of the label empty: V (1 - beta) + what its own faces' backs add [m^3]
  std::vector<double> d_solid;  ///< cost of the label solid: V beta + what its own faces' fronts add [m^3]
};

/// What a cell is labelled, in the byte that stands for it. Unknown: it may be a room that nobody entered, or
/// open air; it is no part of the model, whose surface is that of the empty cells.
struct Label {
  static constexpr std::uint8_t kSolid = 0, kEmpty = 1, kUnknown = 2;
};

/// Whether a cell is empty. Beyond the bounding box, for which -1 stands, all is solid.
inline bool is_empty(const std::vector<std::uint8_t>& label, std::int64_t cell) {
  return cell >= 0 && label[static_cast<std::size_t>(cell)] == Label::kEmpty;
}
inline bool is_empty(const std::vector<std::uint8_t>& label, std::size_t cell) {
  return label[cell] == Label::kEmpty;
}
/// The same for the cell of a face, -1 = beyond the bounding box, in a layer.
inline bool is_empty(const CellComplex& complex, const std::vector<std::uint8_t>& label, std::int32_t face,
                     std::size_t layer) {
  return face >= 0 && is_empty(label, complex.cell(static_cast<std::size_t>(face), layer));
}

inline bool is_unknown(const std::vector<std::uint8_t>& label, std::size_t cell) {
  return label[cell] == Label::kUnknown;
}

/// Labels in their order: 0 solid (also for -1), 1 unknown, 2 empty.
inline int emptiness(const std::vector<std::uint8_t>& label, std::int64_t cell) {
  const std::uint8_t of = cell < 0 ? Label::kSolid : label[static_cast<std::size_t>(cell)];
  return of == Label::kEmpty ? 2 : of == Label::kUnknown ? 1 : 0;
}
inline int emptiness(const CellComplex& complex, const std::vector<std::uint8_t>& label, std::int32_t face,
                     std::size_t layer) {
  return emptiness(
      label, face < 0 ? -1 : static_cast<std::int64_t>(complex.cell(static_cast<std::size_t>(face), layer)));
}

struct Labels {
  std::vector<std::uint8_t> label;       ///< Label per cell
  std::vector<float> margin_m3;          ///< energy that flipping this cell alone would cost [m^3]
  std::vector<std::uint8_t> unobserved;  ///< 1 = too little evidence: labelled, but not to be trusted
  double energy_m3 = 0;                  ///< of this labelling (the optimal cut, then repaired)
  double data_m3 = 0, boundary_m3 = 0;   ///< its two parts
  std::int64_t repair_flips = 0;         ///< labels that the repair to a 2-manifold surface changed
};

/// To which storey and which room each cell belongs, numbered as in summary.json; -1 = solid or unknown.
/// Cells that lie in a door have a storey, but no room.
struct CellRooms {
  std::vector<std::int16_t> storey;
  std::vector<std::int32_t> room;
  std::vector<std::int32_t> unknown_space;  ///< its number in summary.json; -1 = part of none
};

}  // namespace roomcut
