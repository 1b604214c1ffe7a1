// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace roomcut::evaluate {

/// A point on a surface and the area it stands for; 0 for points on edges, which count for maxima only.
struct SurfaceSample {
  Vec3 point{0, 0, 0};
  double area_m2 = 0;
  std::int32_t triangle = 0;
};

/// Samples a mesh: each triangle in n^2 parts, one random point in each (counter-based: a function of the
/// mesh, the spacing and the seed alone), n^2 the triangle's area / spacing^2, rounded up; and its edges at
/// `spacing_m`, ends included, so that thin triangles and corners are not missed. In order of the triangles.
std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, double spacing_m, std::uint64_t seed);

/// How many samples that would be, at most: corners that triangles share are counted for each.
double sample_count(const TriangleMesh& mesh, double spacing_m);

/// The least spacing, `spacing_m` times a power of the root of 2, at which sample_count() is at most
/// `budget`, or at which it does not fall any more: a mesh has samples on every triangle.
double affordable_spacing(const TriangleMesh& mesh, double spacing_m, double budget);

}  // namespace roomcut::evaluate
