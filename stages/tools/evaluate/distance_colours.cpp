// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/distance_colours.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace roomcut::evaluate {

namespace {

std::size_t longest_side(const std::array<Vec3, 3>& t) {
  std::size_t best = 0;
  for (std::size_t c = 1; c < 3; ++c) {
    if ((t[(c + 1) % 3] - t[c]).squaredNorm() > (t[(best + 1) % 3] - t[best]).squaredNorm()) {
      best = c;
    }
  }
  return best;
}

void split(const std::array<Vec3, 3>& first, double limit_m, TriangleMesh& out) {
  std::vector<std::array<Vec3, 3>> open{first};
  while (!open.empty()) {
    const auto t = open.back();
    open.pop_back();
    const std::size_t c = longest_side(t);
    const Vec3 &a = t[c], &b = t[(c + 1) % 3], &top = t[(c + 2) % 3];
    if ((b - a).norm() > limit_m) {
      const Vec3 middle = 0.5 * (a + b);
      open.push_back({middle, b, top});
      open.push_back({a, middle, top});
      continue;
    }
    const auto index = static_cast<std::int32_t>(out.vertices.size());
    out.vertices.insert(out.vertices.end(), t.begin(), t.end());
    out.triangles.push_back({index, index + 1, index + 2});
  }
}

/// About how many pieces split() makes: along a triangle's longest side times across it; a needle falls into
/// three of half its length.
double piece_count(const TriangleMesh& mesh, double limit_m) {
  double count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<Vec3, 3> corners{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
    const std::size_t c = longest_side(corners);
    const double length = (corners[(c + 1) % 3] - corners[c]).norm();
    const double height = length > 0 ? 2 * triangle_area(mesh, t) / length : 0;
    const double along = 1 + length / limit_m;
    count += 2 * std::max(along * (1 + height / limit_m), std::pow(along, std::log2(3.0)));
  }
  return count;
}

/// The longest side that a piece may have: some 100,000 pieces of a building, never many millions.
double longest_piece(const TriangleMesh& model) {
  const double most = std::max(1e6, 10 * static_cast<double>(model.triangles.size()));
  double limit = std::max(0.05, std::sqrt(surface_area(model)) / 200);
  while (piece_count(model, limit) > most) {
    limit *= 2;
  }
  return limit;
}

}  // namespace

DistanceMesh measure_for_display(const TriangleMesh& model, const MeshTree& truth) {
  DistanceMesh out;
  const double limit = longest_piece(model);
  TriangleMesh pieces;
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    split({model.corner(t, 0), model.corner(t, 1), model.corner(t, 2)}, limit, pieces);
  }
  out.mesh = weld_vertices(pieces);
  out.distance_m.resize(out.mesh.vertices.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.distance_m.size(), 512), [&](const auto& range) {
    std::int32_t hint = -1;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const auto hit = truth.nearest(out.mesh.vertices[i], MeshTree::kInfinity, hint);
      out.distance_m[i] = hit.distance;
      hint = hit.triangle;
    }
  });
  return out;
}

}  // namespace roomcut::evaluate
