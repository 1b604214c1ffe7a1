// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/random/counter_random.h"

namespace roomcut::evaluate {

namespace {

/// Parts along each side of a triangle, so that it has parts^2 samples.
double parts(const TriangleMesh& mesh, std::size_t t, double spacing_m) {
  return std::max(std::ceil(std::sqrt(triangle_area(mesh, t)) / spacing_m), 1.0);
}

/// Steps along a side; its ends are no samples of it.
double steps(const Vec3& a, const Vec3& b, double spacing_m) {
  return std::max(std::ceil((b - a).norm() / spacing_m), 1.0);
}

void sample_inside(const TriangleMesh& mesh, std::size_t t, double spacing_m, std::uint64_t seed,
                   std::vector<SurfaceSample>& out) {
  const double area = triangle_area(mesh, t);
  const auto n = static_cast<int>(parts(mesh, t, spacing_m));
  const Vec3& a = mesh.corner(t, 0);
  const Vec3 u = (mesh.corner(t, 1) - a) / n;
  const Vec3 v = (mesh.corner(t, 2) - a) / n;
  std::uint64_t counter = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      for (const bool upper : {false, true}) {  // the two halves of a parallelogram
        if (upper && i + j + 2 > n) {
          continue;
        }
        double r = random_unit(seed, t, counter);
        double s = random_unit(seed, t, counter + 1);
        counter += 2;
        if ((r + s > 1) != upper) {
          r = 1 - r;
          s = 1 - s;
        }
        out.push_back({a + (i + r) * u + (j + s) * v, area / n / n, static_cast<std::int32_t>(t)});
      }
    }
  }
}

void sample_edges(const TriangleMesh& mesh, std::size_t t, double spacing_m,
                  std::vector<SurfaceSample>& out) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (mesh.triangles[t][c] > mesh.triangles[t][(c + 1) % 3]) {
      continue;  // its other triangle does it
    }
    const Vec3& a = mesh.corner(t, static_cast<int>(c));
    const Vec3& b = mesh.corner(t, static_cast<int>((c + 1) % 3));
    const auto count = static_cast<int>(steps(a, b, spacing_m));
    for (int i = 1; i < count; ++i) {
      const double share = static_cast<double>(i) / count;
      out.push_back({(1 - share) * a + share * b, 0, static_cast<std::int32_t>(t)});
    }
  }
}

// Each vertex once, with the first triangle that has it.
void sample_corners(const TriangleMesh& mesh, std::size_t t, std::vector<std::uint8_t>& seen,
                    std::vector<SurfaceSample>& out) {
  for (const std::int32_t v : mesh.triangles[t]) {
    const auto i = static_cast<std::size_t>(v);
    if (seen[i] == 0) {
      seen[i] = 1;
      out.push_back({mesh.vertices[i], 0, static_cast<std::int32_t>(t)});
    }
  }
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, double spacing_m, std::uint64_t seed) {
  std::vector<SurfaceSample> out;
  std::vector<std::uint8_t> seen(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sample_inside(mesh, t, spacing_m, seed, out);
    sample_edges(mesh, t, spacing_m, out);
    sample_corners(mesh, t, seen, out);
  }
  return out;
}

double sample_count(const TriangleMesh& mesh, double spacing_m) {
  double count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double n = parts(mesh, t, spacing_m);
    count += n * n + 3;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t next = (c + 1) % 3;
      if (mesh.triangles[t][c] <= mesh.triangles[t][next]) {  // as sample_edges()
        count +=
            steps(mesh.corner(t, static_cast<int>(c)), mesh.corner(t, static_cast<int>(next)), spacing_m) - 1;
      }
    }
  }
  return count;
}

double affordable_spacing(const TriangleMesh& mesh, double spacing_m, double budget) {
  const double least = 4 * static_cast<double>(mesh.triangles.size());
  while (sample_count(mesh, spacing_m) > std::max(budget, least)) {
    spacing_m *= std::numbers::sqrt2;
  }
  return spacing_m;
}

}  // namespace roomcut::evaluate
