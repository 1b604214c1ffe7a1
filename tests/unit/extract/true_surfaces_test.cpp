// SPDX-License-Identifier: GPL-3.0-or-later
// Models whose floors and ceilings are planes beside their levels.
#include <gtest/gtest.h>

#include <cmath>

#include "stages/extract/extract.h"
#include "tests/unit/extract/grid_complex.h"

namespace roomcut::extract {
namespace {

using test::grid_complex;
using test::label_where;

constexpr double kFloor = 0.5;

LevelSurface plane(const Vec2& gradient, double at_x, double z) {
  LevelSurface surface;
  surface.gradient = gradient;
  surface.c = z - gradient.x() * at_x;
  return surface;
}

/// A house from x = 1 to 5, y = 1 to 4, over the floor kFloor, and its stairs under a roof.
struct House {
  CellComplex complex;
  Labels labels;
  LevelSurfaces surfaces;

  /// `stairs`: the ceiling of the strip between x and the next line.
  House(const std::vector<double>& x, const std::vector<double>& levels,
        const std::function<double(double)>& stairs)
      : complex(grid_complex(x, {0, 1, 2.5, 4, 6}, levels)),
        labels(label_where(complex, [&](const Vec2& p, double z) {
          return p.x() > 1 && p.x() < 5 && p.y() > 1 && p.y() < 4 && z > kFloor && z < stairs(p.x());
        })) {
    surfaces.of_face.assign(complex.levels.size() * complex.faces(), -1);
  }

  void set(bool floor, const LevelSurface& surface, const std::function<bool(const Vec2&)>& where) {
    for (std::size_t i = 0; i < surfaces.of_face.size(); ++i) {
      const std::size_t level = complex.level_of(i);
      const bool below = level > 0 && is_empty(labels.label, i - complex.faces());
      const bool above = level < complex.layers() && is_empty(labels.label, i);
      if (above != below && above == floor && where(complex.centroid(complex.face_of_level(i)))) {
        surfaces.of_face[i] = static_cast<std::int32_t>(surfaces.surfaces.size());
      }
    }
    surfaces.surfaces.push_back(surface);
  }
  void set_ceiling(const LevelSurface& surface, double x0, double x1) {
    set(false, surface, [=](const Vec2& p) { return p.x() > x0 && p.x() < x1; });
  }
  /// The line at x is a crease, no wall.
  void make_crease(double x) {
    for (CellComplex::Line& line : complex.lines) {
      if (std::abs(line.line.distance({x, 0})) < 1e-9 && std::abs(std::cos(line.line.theta)) > 0.9) {
        line.plane = 0;
      }
    }
    complex.planes.emplace_back();
  }
  Model model(const std::vector<Opening>& openings = {}) const {
    return extract_model(complex, labels, openings, {}, surfaces);
  }
};

void expect_sound(const Model& model) {
  EXPECT_EQ(model.fault, "");
  EXPECT_TRUE(model.check.valid()) << describe_faults(model.check);
  EXPECT_EQ(model.put_back_m2, 0);
}

TEST(TrueSurfaces, TheStairsOfAMonopitchBecomeOnePlane) {
  House house({0, 1, 2, 3, 4, 5, 6}, {0, kFloor, 1.25, 1.75, 2.25, 2.75, 4},
              [](double x) { return 1.25 + 0.5 * std::floor(x - 1); });
  EXPECT_GT(house.model().surface.regions.size(), 6U) << "stairs without it";
  house.set_ceiling(plane({0.5, 0}, 1, 1), 1, 5);
  const Model model = house.model();
  expect_sound(model);
  EXPECT_EQ(model.surface.regions.size(), 6U);
  EXPECT_EQ(model.surface.mesh.triangles.size(), 12U);
  EXPECT_NEAR(model.empty_m3, 18, 1e-12);
  EXPECT_NEAR(model.check.volume_m3, 18, 1e-12);
  EXPECT_NEAR(model.areas.ceiling, 3 * std::sqrt(20), 1e-9);
  ASSERT_EQ(model.rooms.size(), 1U);
  EXPECT_NEAR(model.rooms[0].volume_m3, 18, 1e-12);
  EXPECT_NEAR(model.rooms[0].ceiling_z, 2, 1e-12) << "of the plane, at its middle";
  EXPECT_NEAR(model.rooms[0].lowest_ceiling_z, 1, 1e-12);
  EXPECT_NEAR(model.rooms[0].highest_ceiling_z, 3, 1e-12);
}

TEST(TrueSurfaces, AStepWithoutASurfaceFollowsThePlaneBesideIt) {
  House house({0, 1, 2, 3, 4, 5, 6}, {0, kFloor, 1.25, 1.75, 2.25, 2.75, 4},
              [](double x) { return 1.25 + 0.5 * std::floor(x - 1); });
  house.set(false, plane({0.5, 0}, 1, 1),
            [](const Vec2& p) { return p.x() < 2 || p.x() > 3 || p.y() > 2.5; });
  EXPECT_GT(house.model().surface.regions.size(), 6U);
  house.complex.steps = {0, 0, 1, 1, 1, 1, 0};
  const Model model = house.model();
  expect_sound(model);
  EXPECT_EQ(model.surface.regions.size(), 6U);
  EXPECT_NEAR(model.empty_m3, 18, 1e-12);
}

House gable(double ridge_off) {
  House house({0, 1, 2, 3, 4, 5, 6}, {0, kFloor, 1.5, 2.5, 4},
              [](double x) { return std::abs(x - 3) < 1 ? 2.5 : 1.5; });
  house.set_ceiling(plane({1, 0}, 3, 3), 1, 3);
  house.set_ceiling(plane({-1, 0}, 3 + 2 * ridge_off, 3), 3, 5);
  return house;
}

TEST(TrueSurfaces, TwoPlanesMeetInARidgeWhereTheyDoAndNotWhereTheLineWasDrawn) {
  for (const double off : {0.0, 0.004, -0.007}) {
    House house = gable(off);
    house.make_crease(3);
    const Model model = house.model();
    expect_sound(model);
    EXPECT_EQ(model.surface.regions.size(), 7U) << off;
    EXPECT_EQ(model.surface.mesh.triangles.size(), 16U) << off;
    EXPECT_NEAR(bounds(model.surface.mesh).hi.z(), 3 + off, 1e-12);
    // Over z = kFloor: from x = 1 up to the ridge at 3 + off, and down to 5.
    const double left = (2 + off) * (0.5 + 2.5 + off) / 2;
    const double right = (2 - off) * (2.5 + off + 0.5 + 2 * off) / 2;
    EXPECT_NEAR(model.empty_m3, 3 * (left + right), 1e-9);
    EXPECT_NEAR(model.check.volume_m3, model.empty_m3, 1e-9);
  }
}

TEST(TrueSurfaces, WhereALineIsAWallsTheStripBetweenTwoPlanesStays) {
  const Model model = gable(0.004).model();
  expect_sound(model);
  EXPECT_EQ(model.surface.regions.size(), 8U);
}

/// A roof that comes down to the floor at x = 1 and 5, whose floor was fitted `raised` over its level.
House attic(double raised) {
  House house({0, 1, 2, 3, 4, 5, 6}, {0, kFloor, 1, 2, 4},
              [](double x) { return std::abs(x - 3) < 1 ? 2 : 1; });
  house.set_ceiling(plane({1, 0}, 1, kFloor), 1, 3);
  house.set_ceiling(plane({-1, 0}, 5, kFloor), 3, 5);
  house.set(true, plane({0, 0}, 0, kFloor + raised), [](const Vec2&) { return true; });
  return house;
}

TEST(TrueSurfaces, ARoofThatMeetsTheFloorEndsInAnEdge) {
  for (const double raised : {0.0, 0.01, 0.1}) {
    for (const bool creases : {false, true}) {
      House house = attic(raised);
      if (creases) {
        house.make_crease(1);
        house.make_crease(5);
      }
      const Model model = house.model();
      expect_sound(model);
      EXPECT_EQ(model.surface.regions.size(), 5U) << raised << creases;
      EXPECT_EQ(model.surface.mesh.triangles.size(), 8U) << raised << creases;
      EXPECT_NEAR(model.empty_m3, 3 * (2 - raised) * (2 - raised), 1e-9);
      EXPECT_NEAR(bounds(model.surface.mesh).lo.x(), 1 + raised, 1e-9);
    }
  }
}

TEST(TrueSurfaces, AFloorBelowItMeetsTheRoofAtItsCrease) {
  House house = attic(-0.01);
  EXPECT_EQ(house.model().surface.regions.size(), 7U) << "two strips of a centimetre";
  house.make_crease(1);
  house.make_crease(5);
  const Model model = house.model();
  expect_sound(model);
  EXPECT_EQ(model.surface.regions.size(), 5U);
  EXPECT_NEAR(model.empty_m3, 3 * 2.01 * 2.01, 1e-9);
}

/// Two rooms side by side, x 1 … 3 and 3.2 … 5.
House two_rooms() {
  House house({0, 1, 3, 3.2, 5, 6}, {0, kFloor, 3, 4}, [](double x) { return x > 3 && x < 3.2 ? 0 : 3; });
  return house;
}

Opening door() {
  Opening opening;
  opening.id = "o0001";
  opening.wall_a = "w1";
  opening.wall_b = "w2";
  opening.jamb_a = {3.1, 1.5};
  opening.jamb_b = {3.1, 2.4};
  opening.thickness_m = 0.2;
  opening.sill_z = kFloor;
  opening.head_z = 2.5;
  return opening;
}

TEST(TrueSurfaces, EveryRoomHasItsOwnHeights) {
  House house = two_rooms();
  const auto left = [](const Vec2& p) { return p.x() < 3; };
  const auto right = [](const Vec2& p) { return p.x() > 3.2; };
  house.set(true, plane({0, 0}, 0, kFloor + 0.01), left);
  house.set(false, plane({0, 0}, 0, 3.02), left);
  house.set(true, plane({0, 0}, 0, kFloor - 0.005), right);
  const Model model = house.model({door()});
  expect_sound(model);
  EXPECT_TRUE(model.refused.empty());
  ASSERT_EQ(model.rooms.size(), 2U);
  EXPECT_NEAR(model.rooms[0].floor_z, kFloor + 0.01, 1e-12);
  EXPECT_NEAR(model.rooms[0].ceiling_z, 3.02, 1e-12);
  EXPECT_NEAR(model.rooms[0].volume_m3, 2 * 3 * 2.51, 1e-9);
  EXPECT_NEAR(model.rooms[1].floor_z, kFloor - 0.005, 1e-12);
  EXPECT_EQ(model.rooms[1].ceiling_z, 3);
  // The door's floor is the first room's, its head stays.
  EXPECT_NEAR(model.empty_m3, 6 * 2.51 + 1.8 * 3 * 2.505 + 0.2 * 0.9 * 1.99, 1e-9);
  EXPECT_NEAR(model.areas.ceiling, 6 + 5.4 + 0.18, 1e-9);
}

TEST(TrueSurfaces, WithoutAnySurfaceTheyAreTheLevels) {
  const House house = two_rooms();
  const Model with = house.model({door()});
  const Model without = extract_model(house.complex, house.labels, {door()}, {});
  EXPECT_EQ(with.surface.mesh.triangles, without.surface.mesh.triangles);
  EXPECT_EQ(with.surface.mesh.vertices, without.surface.mesh.vertices);
}

TEST(TrueSurfaces, ASlabThatTheyWouldCrossStaysAsThickAsItsLevels) {
  House house({0, 1, 5, 6}, {0, kFloor, 2.5, 2.6, 5, 6}, [](double) { return 5; });
  for (std::size_t f = 0; f < house.complex.faces(); ++f) {
    house.labels.label[house.complex.cell(f, 2)] = Label::kSolid;  // a slab from 2.5 to 2.6
  }
  house.set(false, plane({0.1, 0}, 1, 2.5), [](const Vec2&) { return true; });  // both ceilings
  for (std::size_t f = 0; f < house.complex.faces(); ++f) {
    house.surfaces.of_face[house.complex.level_face(f, 4)] = -1;
  }
  const Model model = house.model();
  EXPECT_EQ(model.fault, "");
  EXPECT_NEAR(model.put_back_m2, 12, 1e-9);
  EXPECT_NEAR(model.empty_m3, 12 * (2 + 2.4), 1e-9);
}

TEST(TrueSurfaces, WhereTheModelWouldTouchItselfOnlyWhatIsBesideGoesBack) {
  // Of the four faces around (3, 2.5) two that meet in a corner are raised; a face far from it is, too.
  House house({0, 1, 2, 3, 4, 5, 6}, {0, kFloor, 3, 4}, [](double) { return 3; });
  house.set(true, plane({0, 0}, 0, kFloor + 0.1), [](const Vec2& p) {
    return (p.x() > 2 && p.x() < 3 && p.y() < 2.5) || (p.x() > 3 && p.x() < 4 && p.y() > 2.5);
  });
  house.set(true, plane({0, 0}, 0, kFloor + 0.2), [](const Vec2& p) { return p.x() < 2 && p.y() > 2.5; });
  const Model model = house.model();
  EXPECT_EQ(model.fault, "");
  EXPECT_NEAR(model.put_back_m2, 1.5, 1e-9);
  EXPECT_NEAR(model.empty_m3, 12 * 2.5 - 1.5 * 0.1 - 1.5 * 0.2, 1e-9);
}

}  // namespace
}  // namespace roomcut::extract
