// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "common/mesh/triangle_mesh.h"

namespace roomcut {

/// The faults of a triangle mesh, as it is indexed (weld_vertices() first to judge by coordinates).
struct MeshCheck {
  std::int64_t vertices = 0, edges = 0, triangles = 0;
  std::int64_t degenerate_triangles = 0;  ///< a corner twice, or no area (exact)
  std::int64_t open_edges = 0;            ///< edges of one triangle
  std::int64_t nonmanifold_edges = 0;     ///< edges of more than two triangles
  std::int64_t misoriented_edges = 0;     ///< edges that two triangles run through in the same direction
  std::int64_t nonmanifold_vertices = 0;  ///< vertices whose triangles are not one fan
  std::int64_t self_intersections =
      0;                        ///< pairs of triangles that meet outside shared corners; -1 = not checked
  std::int64_t components = 0;  ///< joined through vertices
  std::int64_t euler = 0;       ///< V - E + F
  double area_m2 = 0;
  double volume_m3 = 0;  ///< signed; positive with normals out of the enclosed space

  bool closed() const { return triangles > 0 && open_edges == 0; }
  bool oriented() const { return misoriented_edges == 0; }
  bool manifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0; }
  /// Closed, oriented 2-manifold without degenerate triangles and self-intersections.
  bool valid() const {
    return closed() && oriented() && manifold() && degenerate_triangles == 0 && self_intersections == 0;
  }
};

/// Checks a mesh. Connectivity is counted exactly on the indices; self-intersections by CGAL (Surface_mesh,
/// Polygon Mesh Processing, exact predicates), which needs a manifold and is left out (-1) otherwise.
MeshCheck check_mesh(const TriangleMesh& mesh);

/// "" for a valid mesh, else everything that is wrong, in words.
std::string describe_faults(const MeshCheck& check);

}  // namespace roomcut
