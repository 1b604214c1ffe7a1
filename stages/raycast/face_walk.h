// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "common/cells/cell_complex.h"

namespace roomcut::raycast {

/// A face of the complex as a ray meets it.
struct Crossing {
  double distance;  ///< along the ray [m]
  float omega;      ///< covered share
  float front;      ///< completed share of surface that shows the ray its front: empty on the ray's side
  float back;  ///< … its back: solid on the ray's side; front + back <= 1, what is left lets the ray through
  float seen_front;  ///< the share that was seen of that front, not completed
  std::size_t cell;  ///< the cell that the ray leaves here
};

struct Ray {
  Vec3 origin;
  Vec3 direction;           ///< unit vector
  std::size_t face, layer;  ///< the cell that holds the origin
};

/// Follows rays from cell to cell through the complex. No search structure: a convex cell is left by the
/// one side whose ends lie on both sides of the ray, so the crossings come sorted. Steps per ray: the cells
/// it passes.
class FaceWalk {
 public:
  /// Both must outlive the walk.
  FaceWalk(const CellComplex& complex, const FaceWeights& weights);

  /// All faces that the ray crosses within `limit_m` [m] until it leaves the bounding box or less than
  /// `opaque` of it is left, nearest first; `crossings` is overwritten.
  void follow(const Ray& ray, std::vector<Crossing>& crossings,
              double limit_m = std::numeric_limits<double>::infinity(), double opaque = 0) const;

  /// A point of the face, uniform by area, from two numbers in [0, 1).
  Vec2 point_in(std::size_t face, double u, double v) const;

 private:
  struct Side {
    double ax, ay;     // its first corner
    double nx, ny, d;  // outward: nx x + ny y = d
    std::int32_t edge;
    std::int32_t neighbour;  // -1 = beyond the bounding box
    bool is_left;            // the face lies left of the edge
  };

  struct Exit {
    const Side* side = nullptr;  // null when the ray runs straight up or down
    double at = std::numeric_limits<double>::infinity();
  };
  std::size_t first_corner(std::size_t face) const;
  Exit side_exit(const Ray& ray, std::size_t face) const;
  double level_exit(const Ray& ray, std::size_t layer) const;
  Crossing through_side(const Side& side, std::size_t face, std::size_t layer, double at) const;
  Crossing through_level(bool up, std::size_t face, std::size_t layer, double at) const;

  const CellComplex& complex_;
  const FaceWeights& weights_;
  struct Sides {
    float front, back;  // seen from the left, or from above
  };
  std::vector<Sides> walls_, levels_;  // completed
  std::vector<Side> sides_;            // parallel to complex.face_vertex
};

}  // namespace roomcut::raycast
