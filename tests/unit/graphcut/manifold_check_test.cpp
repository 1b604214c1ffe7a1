// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/manifold_check.h"

#include <gtest/gtest.h>

#include "tests/unit/graphcut/manifold_by_mesh.h"
#include "tests/unit/graphcut/random_cells.h"

namespace roomcut::graphcut {
using namespace roomcut::testing;

namespace {

TEST(ManifoldCheck, AgreesWithTheMeshOfTheSurfaceAtEveryVertex) {
  std::size_t bad_places = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const CellComplex complex =
        random_complex(seed, 8 + static_cast<int>(seed % 20), 1 + static_cast<int>(seed % 4));
    const ManifoldCheck check(complex);
    for (const double share : {0.1, 0.5, 0.9}) {
      const std::vector<std::uint8_t> label = random_labels(complex, seed, share);
      std::set<std::pair<int, int>> found;
      for (const Place& place : check.find_all(label)) {
        found.emplace(place.level, place.vertex);
      }
      EXPECT_EQ(found, non_manifold_vertices(complex, label)) << "seed " << seed << ", share " << share;
      bad_places += found.size();
    }
  }
  EXPECT_GT(bad_places, 1000U);
}

TEST(ManifoldCheck, FindsCellsThatTouchAtAnEdgeOrAVertexOnly) {
  const CellComplex complex = grid_complex(4, 4, 4);
  const ManifoldCheck check(complex);
  const auto cell_at = [&](double x, double y, std::size_t layer) {
    for (std::size_t f = 0; f < complex.faces(); ++f) {
      if ((complex.centroid(f) - Vec2(x, y)).norm() < 0.1) {
        return complex.cell(f, layer);
      }
    }
    return complex.cells();
  };
  const auto bad_places_with = [&](std::size_t a, std::size_t b) {
    std::vector<std::uint8_t> label(complex.cells(), 0);
    label.at(a) = label.at(b) = 1;
    return check.find_all(label).size();
  };
  const std::size_t middle = cell_at(1.5, 1.5, 1);
  EXPECT_EQ(bad_places_with(middle, cell_at(2.5, 1.5, 1)), 0U);  // a face
  EXPECT_EQ(bad_places_with(middle, cell_at(2.5, 2.5, 1)), 2U);  // a vertical edge: both its ends
  EXPECT_EQ(bad_places_with(middle, cell_at(2.5, 1.5, 2)), 2U);  // a horizontal edge
  EXPECT_EQ(bad_places_with(middle, cell_at(2.5, 2.5, 2)), 1U);  // a vertex
}

}  // namespace
}  // namespace roomcut::graphcut
