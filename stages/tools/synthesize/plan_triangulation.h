// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cstdint>

namespace roomcut::synthesize {

/// A triangulation of the plan: vertices know their index, faces the region that they belong to.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<std::int32_t, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Cdt =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                               CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

inline constexpr std::int32_t kUnset = -1;  ///< a face of no region yet

/// Gives `region` to all triangles that are reached from `seed` without crossing a constraint, and returns
/// the largest.
Cdt::Face_handle flood(const Cdt& cdt, Cdt::Face_handle seed, std::int32_t region);

}  // namespace roomcut::synthesize
