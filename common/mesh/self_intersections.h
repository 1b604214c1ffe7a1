// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace roomcut {

/// Pairs of triangles that meet outside shared corners, found by CGAL's exact predicates; -1 when CGAL does
/// not take the triangles as a polygon mesh. Triangles without area count as a pair with themselves.
std::int64_t count_self_intersections(const TriangleMesh& mesh);

/// The triangles of these pairs, ascending; none when CGAL does not take them as a polygon mesh.
std::vector<std::size_t> self_intersecting_triangles(const TriangleMesh& mesh);

/// Triangles whose corners are exactly on one line.
std::int64_t count_degenerate_triangles(const TriangleMesh& mesh);

}  // namespace roomcut
