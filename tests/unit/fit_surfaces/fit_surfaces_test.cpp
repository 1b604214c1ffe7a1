// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/fit_surfaces.h"

#include <gtest/gtest.h>

#include "tests/unit/extract/grid_complex.h"
#include "tests/unit/fit_surfaces/made_floors.h"

namespace roomcut::fit_surfaces {
namespace {

using roomcut::testing::add_flat;
using roomcut::testing::add_floor;
using roomcut::testing::Normal;

constexpr double kNoise = 0.005;
constexpr double kDensity = 400;  // points per square metre

/// Three rooms of 4 × 5 m side by side, walls of 0.2 m, one layer from 0 to 2.75 m. Faces 1, 3 and 5 of the
/// middle row are the rooms.
CellComplex three_rooms() {
  return test::grid_complex({-1, 0, 4, 4.2, 8.2, 8.4, 12.4, 13.4}, {-1, 0, 5, 6}, {0, 2.75});
}
Labels labels_of_three_rooms(const CellComplex& complex) {
  return test::label_where(complex, [](const Vec2& p, double /*z*/) {
    const double x = std::fmod(p.x(), 4.2);
    return p.y() > 0 && p.y() < 5 && p.x() > 0 && p.x() < 12.4 && x < 4;
  });
}

struct Heights {
  double floor, ceiling;
};

void add_room(CloudTile& tile, Normal& random, int room, const Heights& heights, double noise = kNoise) {
  const Vec2 low(4.2 * room, 0);
  const Vec2 high = low + Vec2(4, 5);
  add_floor(tile, random, low, high, kDensity, noise, [&](const Vec2&) { return heights.floor; });
  add_floor(tile, random, low, high, kDensity, noise, [&](const Vec2&) { return heights.ceiling; });
}

FittedSurfaces fit(const CellComplex& complex, const Labels& labels, const std::vector<CloudTile>& tiles,
                   const FitSurfacesParams& params = {}, double noise = kNoise) {
  CloudHeader header;
  header.noise_m = noise;
  SurfaceFitter fitter(complex, labels.label, header, params);
  for (const CloudTile& tile : tiles) {
    fitter.add(tile);
  }
  return fitter.fit();
}

const LevelSurface* at(const CellComplex& complex, const FittedSurfaces& fitted, const Vec2& p,
                       std::size_t level) {
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    if ((complex.centroid(f) - p).norm() < 0.05) {
      const std::int32_t index = fitted.surfaces.of_face[complex.level_face(f, level)];
      return index < 0 ? nullptr : &fitted.surfaces.surfaces[static_cast<std::size_t>(index)];
    }
  }
  return nullptr;
}

TEST(FitSurfaces, RoomsThatDifferByOneToThreeCentimetresHaveTheirOwnHeightsWithinAMillimetre) {
  const CellComplex complex = three_rooms();
  const Labels labels = labels_of_three_rooms(complex);
  int inside = 0;
  int all = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Normal random(seed);
    CloudTile tile;
    const Heights truth[] = {{0.0, 2.73}, {0.02, 2.75}, {-0.01, 2.76}};
    for (int room = 0; room < 3; ++room) {
      add_room(tile, random, room, truth[room]);
    }
    const FittedSurfaces fitted = fit(complex, labels, {tile});
    for (int room = 0; room < 3; ++room) {
      const Vec2 middle(4.2 * room + 2, 2.5);
      for (std::size_t level = 0; level < 2; ++level) {
        const LevelSurface* surface = at(complex, fitted, middle, level);
        ASSERT_NE(surface, nullptr);
        const double error = surface->height(middle) - (level == 0 ? truth[room].floor : truth[room].ceiling);
        EXPECT_LT(std::abs(error), 0.001) << "room " << room << " level " << level << " seed " << seed;
        EXPECT_LT(surface->sigma_m, 0.0005);
        EXPECT_EQ(surface->gradient, Vec2(0, 0));
        EXPECT_EQ(surface->plane, -1);
        EXPECT_NEAR(surface->area_m2, 20, 1e-9);
        inside += std::abs(error) < 1.96 * surface->sigma_m ? 1 : 0;
        ++all;
      }
    }
  }
  EXPECT_GE(inside, 0.95 * all);
}

TEST(FitSurfaces, RoomsOfOneHeightShareWhatTheirPointsSay) {
  const CellComplex complex = three_rooms();
  Normal random(3);
  CloudTile tile;
  for (int room = 0; room < 3; ++room) {
    add_room(tile, random, room, {0.01, 2.74}, 0.02);
  }
  const FittedSurfaces fitted = fit(complex, labels_of_three_rooms(complex), {tile}, {}, 0.02);
  const double first = at(complex, fitted, {2, 2.5}, 0)->c;
  EXPECT_NEAR(at(complex, fitted, {6.2, 2.5}, 0)->c, first, 1e-12);
  EXPECT_NEAR(at(complex, fitted, {10.4, 2.5}, 0)->c, first, 1e-12);
  EXPECT_NEAR(first, 0.01, 0.0006);
}

TEST(FitSurfaces, FurnitureOnTheFloorAndLampsUnderTheCeilingDoNotCount) {
  const CellComplex complex = three_rooms();
  Normal random(5);
  CloudTile tile;
  for (int room = 0; room < 3; ++room) {
    add_room(tile, random, room, {0.01, 2.74});
    const Vec2 low(4.2 * room + 0.5, 0.5);
    // A third of the floor is under books and thresholds, a third of the ceiling has a soffit or lamps.
    add_floor(tile, random, low, low + Vec2(1.5, 4), kDensity, kNoise, [](const Vec2&) { return 0.05; });
    add_floor(tile, random, low, low + Vec2(1.5, 4), kDensity, kNoise, [](const Vec2&) { return 2.70; });
  }
  const FittedSurfaces fitted = fit(complex, labels_of_three_rooms(complex), {tile});
  for (int room = 0; room < 3; ++room) {
    const Vec2 middle(4.2 * room + 2, 2.5);
    EXPECT_NEAR(at(complex, fitted, middle, 0)->height(middle), 0.01, 0.0005);
    EXPECT_NEAR(at(complex, fitted, middle, 1)->height(middle), 2.74, 0.0005);
    EXPECT_EQ(at(complex, fitted, middle, 0)->gradient, Vec2(0, 0));
  }
}

TEST(FitSurfaces, AFloorThatFallsByOnePercentIsFollowedAndTheCeilingStaysLevel) {
  const CellComplex complex = test::grid_complex({-1, 0, 7, 14, 15}, {-1, 0, 8, 9}, {0.07, 3.1});
  const Labels labels = test::label_where(
      complex, [](const Vec2& p, double /*z*/) { return p.x() > 0 && p.x() < 14 && p.y() > 0 && p.y() < 8; });
  Normal random(7);
  CloudTile tile;
  add_floor(tile, random, {0, 0}, {14, 8}, 200, kNoise, [](const Vec2& p) { return 0.01 * p.x(); });
  add_floor(tile, random, {0, 0}, {14, 8}, 200, kNoise, [](const Vec2&) { return 3.1; });
  const FittedSurfaces fitted = fit(complex, labels, {tile});
  const LevelSurface* floor = at(complex, fitted, {3.5, 4}, 0);
  ASSERT_NE(floor, nullptr);
  EXPECT_EQ(floor, at(complex, fitted, {10.5, 4}, 0)) << "both faces are one floor";
  EXPECT_NEAR(floor->gradient.x(), 0.01, 2e-5);
  EXPECT_NEAR(floor->gradient.y(), 0, 5e-5);
  EXPECT_NEAR(floor->c, 0, 0.0004);
  EXPECT_EQ(at(complex, fitted, {3.5, 4}, 1)->gradient, Vec2(0, 0));
  FitSurfacesParams level;
  level.tilt = false;
  EXPECT_EQ(at(complex, fit(complex, labels, {tile}, level), {3.5, 4}, 0)->gradient, Vec2(0, 0));
}

TEST(FitSurfaces, ARaisedPartOfARoomIsAFloorOfItsOwn) {
  const CellComplex complex = test::grid_complex({-1, 0, 5, 9, 10}, {-1, 0, 4, 5}, {0.01, 2.7});
  const Labels labels = test::label_where(
      complex, [](const Vec2& p, double /*z*/) { return p.x() > 0 && p.x() < 9 && p.y() > 0 && p.y() < 4; });
  Normal random(9);
  CloudTile tile;
  add_floor(tile, random, {0, 0}, {9, 4}, kDensity, kNoise,
            [](const Vec2& p) { return p.x() < 5 ? 0.0 : 0.02; });
  add_floor(tile, random, {0, 0}, {9, 4}, kDensity, kNoise, [](const Vec2&) { return 2.7; });
  const FittedSurfaces fitted = fit(complex, labels, {tile});
  EXPECT_NEAR(at(complex, fitted, {2.5, 2}, 0)->c, 0.0, 0.0005);
  EXPECT_NEAR(at(complex, fitted, {7, 2}, 0)->c, 0.02, 0.0005);
  EXPECT_EQ(at(complex, fitted, {2.5, 2}, 1), at(complex, fitted, {7, 2}, 1)) << "the ceiling is one";
  EXPECT_EQ(fitted.split, 1U);
}

TEST(FitSurfaces, WhatNobodySawKeepsItsLevel) {
  const CellComplex complex = three_rooms();
  Normal random(11);
  CloudTile tile;
  add_room(tile, random, 0, {0.02, 2.74});
  // Of the third room a strip that stands 8 cm over its level: not enough to believe it.
  add_floor(tile, random, {8.6, 0.2}, {9.6, 2.2}, kDensity, kNoise, [](const Vec2&) { return 0.08; });
  const FittedSurfaces fitted = fit(complex, labels_of_three_rooms(complex), {tile});
  EXPECT_NE(at(complex, fitted, {2, 2.5}, 0), nullptr);
  EXPECT_EQ(at(complex, fitted, {6.2, 2.5}, 0), nullptr);
  EXPECT_EQ(at(complex, fitted, {10.4, 2.5}, 0), nullptr);
  EXPECT_EQ(fitted.unseen, 4U);
}

TEST(FitSurfaces, PointsOfWallsAndAtTheFootOfWallsDoNotCount) {
  const CellComplex complex = three_rooms();
  Normal random(13);
  CloudTile tile;
  add_room(tile, random, 0, {0.0, 2.75});
  const FittedSurfaces clean = fit(complex, labels_of_three_rooms(complex), {tile});
  add_floor(
      tile, random, {0, 0}, {4, 5}, kDensity, kNoise, [](const Vec2&) { return 0.03; }, SurfaceClass::kWall);
  add_floor(tile, random, {0, 0}, {4, 0.025}, 20 * kDensity, kNoise, [](const Vec2&) { return 0.03; });
  const FittedSurfaces fitted = fit(complex, labels_of_three_rooms(complex), {tile});
  EXPECT_EQ(at(complex, fitted, {2, 2.5}, 0)->c, at(complex, clean, {2, 2.5}, 0)->c);
}

TEST(FitSurfaces, TheOrderOfThePointsDoesNotMatter) {
  const CellComplex complex = three_rooms();
  const Labels labels = labels_of_three_rooms(complex);
  Normal random(15);
  CloudTile whole;
  for (int room = 0; room < 3; ++room) {
    add_room(whole, random, room, {0.01 * room, 2.74});
  }
  std::vector<CloudTile> parts(3);
  for (std::size_t i = whole.size(); i-- > 0;) {
    add_flat(parts[i % 3], Vec2(whole.x[i], whole.y[i]), whole.z[i], SurfaceClass::kHorizontal);
  }
  const FittedSurfaces one = fit(complex, labels, {whole});
  const FittedSurfaces other = fit(complex, labels, parts);
  ASSERT_EQ(one.surfaces.surfaces.size(), other.surfaces.surfaces.size());
  for (std::size_t i = 0; i < one.surfaces.surfaces.size(); ++i) {
    EXPECT_EQ(one.surfaces.surfaces[i].c, other.surfaces.surfaces[i].c);
    EXPECT_EQ(one.surfaces.surfaces[i].sigma_m, other.surfaces.surfaces[i].sigma_m);
  }
}

}  // namespace
}  // namespace roomcut::fit_surfaces
