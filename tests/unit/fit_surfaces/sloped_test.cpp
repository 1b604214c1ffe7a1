// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "stages/fit_surfaces/fit_surfaces.h"
#include "tests/unit/extract/grid_complex.h"
#include "tests/unit/fit_surfaces/made_floors.h"

namespace roomcut::fit_surfaces {
namespace {

using roomcut::testing::add_floor;
using roomcut::testing::Normal;

constexpr double kNoise = 0.005;

/// An attic of 4 × 6 m whose ceiling rises from 1 m to 3 m over x = 0 … 4: steps at 1.5 and 2.5 m, risers at
/// x = 2, closed above at 3.3 m.
CellComplex attic() {
  CellComplex complex = test::grid_complex({-1, 0, 2, 4, 5}, {-1, 0, 6, 7}, {0, 1.5, 2.5, 3.3});
  complex.steps = {0, 1, 1, 0};
  SlopedPlane plane;
  plane.gradient = {0.502, 0.001};  // nearly: slice saw it in large voxels
  plane.c = 1.004;
  plane.outline = {{0.1, 0.1}, {3.9, 0.1}, {3.9, 5.9}, {0.1, 5.9}};
  plane.rms_m = 0.004;
  complex.planes = {plane};
  return complex;
}
Labels labels_of_attic(const CellComplex& complex) {
  return test::label_where(complex, [](const Vec2& p, double z) {
    const bool inside = p.x() > 0 && p.x() < 4 && p.y() > 0 && p.y() < 6;
    return inside && z < (p.x() < 2 ? 1.5 : 2.5);
  });
}

FittedSurfaces fit_attic(const CellComplex& complex, const CloudTile& tile,
                         const std::vector<std::uint8_t>& held = {}) {
  CloudHeader header;
  header.noise_m = kNoise;
  const Labels labels = labels_of_attic(complex);
  SurfaceFitter fitter(complex, labels.label, header, {});
  fitter.add(tile);
  return fitter.fit(held);
}

std::vector<const LevelSurface*> roof_of(const CellComplex& complex, const FittedSurfaces& fitted) {
  std::vector<const LevelSurface*> roof;
  for (const std::size_t level : {1, 2}) {
    for (std::size_t f = 0; f < complex.faces(); ++f) {
      const std::int32_t index = fitted.surfaces.of_face[complex.level_face(f, level)];
      if (index >= 0) {
        roof.push_back(&fitted.surfaces.surfaces[static_cast<std::size_t>(index)]);
      }
    }
  }
  return roof;
}

TEST(SlopedSurfaces, AllTreadsOfARoofAreOnePlaneFittedToTheRawPoints) {
  const CellComplex complex = attic();
  Normal random(1);
  CloudTile tile;
  add_floor(
      tile, random, {0, 0}, {4, 6}, 200, kNoise, [](const Vec2& p) { return 1 + 0.5 * p.x(); },
      SurfaceClass::kSloped);
  add_floor(tile, random, {0, 0}, {4, 6}, 200, kNoise, [](const Vec2&) { return 0.01; });
  const FittedSurfaces fitted = fit_attic(complex, tile);
  const auto roof = roof_of(complex, fitted);
  ASSERT_EQ(roof.size(), 2U);
  EXPECT_EQ(roof[0], roof[1]);
  EXPECT_EQ(roof[0]->plane, 0);
  EXPECT_NEAR(roof[0]->gradient.x(), 0.5, 0.0005);
  EXPECT_NEAR(roof[0]->gradient.y(), 0, 0.0005);
  EXPECT_NEAR(roof[0]->height({2, 3}), 2, 0.0005);
  EXPECT_NEAR(roof[0]->area_m2, 24, 1e-9);
  EXPECT_LT(roof[0]->sigma_m, 0.001);
}

TEST(SlopedSurfaces, WithoutPointsTheRoofIsThePlaneThatSliceFound) {
  const CellComplex complex = attic();
  const FittedSurfaces fitted = fit_attic(complex, {});
  const auto roof = roof_of(complex, fitted);
  ASSERT_EQ(roof.size(), 2U);
  EXPECT_EQ(roof[0]->gradient, complex.planes[0].gradient);
  EXPECT_EQ(roof[0]->c, complex.planes[0].c);
  EXPECT_EQ(roof[0]->points, 0);
}

TEST(SlopedSurfaces, APlaneThatIsLockedStaysAsDrawnWhateverThePoints) {
  const CellComplex complex = attic();
  Normal random(1);
  CloudTile tile;
  add_floor(
      tile, random, {0, 0}, {4, 6}, 200, kNoise, [](const Vec2& p) { return 1 + 0.5 * p.x(); },
      SurfaceClass::kSloped);
  const FittedSurfaces fitted = fit_attic(complex, tile, {1});
  ASSERT_EQ(roof_of(complex, fitted).size(), 2U);
  EXPECT_EQ(roof_of(complex, fitted)[0]->gradient, complex.planes[0].gradient);
  EXPECT_NE(roof_of(complex, fit_attic(complex, tile, {0}))[0]->gradient, complex.planes[0].gradient);
}

TEST(SlopedSurfaces, ARealLevelBelowTheRoofStaysLevel) {
  // Left of x = 2 the ceiling is level at 1.5 m, a level of its own that the plane crosses at x = 1.
  CellComplex complex = attic();
  complex.steps = {0, 0, 1, 0};
  Normal random(2);
  CloudTile tile;
  add_floor(tile, random, {0, 0}, {2, 6}, 200, kNoise, [](const Vec2&) { return 1.52; });
  add_floor(
      tile, random, {2, 0}, {4, 6}, 200, kNoise, [](const Vec2& p) { return 1 + 0.5 * p.x(); },
      SurfaceClass::kSloped);
  const FittedSurfaces fitted = fit_attic(complex, tile);
  const auto roof = roof_of(complex, fitted);
  ASSERT_EQ(roof.size(), 2U);
  EXPECT_EQ(roof[0]->plane, -1);
  EXPECT_NEAR(roof[0]->c, 1.52, 0.0005);
  EXPECT_EQ(roof[1]->plane, 0);
}

}  // namespace
}  // namespace roomcut::fit_surfaces
