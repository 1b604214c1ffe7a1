// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/cut_openings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/cells/face_locator.h"
#include "common/random/counter_random.h"
#include "stages/extract/extract.h"
#include "tests/unit/extract/grid_complex.h"

namespace roomcut::extract {
namespace {

using test::grid_complex;
using test::label_where;

/// Two rooms, x 1 … 4 and 4.2 … 8, y 1 … 5, z 0 … 2.5, in a plan whose lines also cut the wall's solid.
struct TwoRooms {
  double angle;
  CellComplex complex;
  Labels labels;

  explicit TwoRooms(double by = 0)
      : angle(by),
        complex(grid_complex({0, 1, 4, 4.1, 4.2, 8, 9}, {0, 1, 2.2, 3, 5, 6}, {-1, 0, 1.1, 2.5, 3}, by)),
        labels(label_where(complex, [&](const Vec2& p, double z) {
          const Vec2 q = turned(p, -angle);
          return z > 0 && z < 2.5 && q.y() > 1 && q.y() < 5 &&
                 ((q.x() > 1 && q.x() < 4) || (q.x() > 4.2 && q.x() < 8));
        })) {}

  static Vec2 turned(const Vec2& p, double by) {
    return {std::cos(by) * p.x() - std::sin(by) * p.y(), std::sin(by) * p.x() + std::cos(by) * p.y()};
  }
  /// A door in the wall; its faces are the lines w1 (x = 4) and w3 (x = 4.2).
  Opening door(double y0, double y1, double head, const std::string& id = "o0001") const {
    Opening opening;
    opening.id = id;
    opening.wall_a = "w1";
    opening.wall_b = "w3";
    opening.jamb_a = turned({4.1, y0}, angle);
    opening.jamb_b = turned({4.1, y1}, angle);
    opening.thickness_m = 0.2;
    opening.sill_z = 0;
    opening.head_z = head;
    return opening;
  }
};

double closed_m3(const TwoRooms& rooms) {
  return extract_model(rooms.complex, rooms.labels, {}, {}).empty_m3;
}

TEST(CutOpenings, ADoorAddsExactlyItsVolumeAndTheRoomsStayApart) {
  for (const double angle : {0.0, 0.35, 1.9}) {
    const TwoRooms rooms(angle);
    const Model model = extract_model(rooms.complex, rooms.labels, {rooms.door(1.7, 2.6, 2.05)}, {});
    EXPECT_EQ(model.fault, "");
    EXPECT_NEAR(model.empty_m3, closed_m3(rooms) + 0.9 * 2.05 * 0.2, 1e-9);
    EXPECT_EQ(model.check.components, 1);
    EXPECT_EQ(model.check.euler, 2) << "one body without a handle";
    ASSERT_EQ(model.rooms.size(), 2U);
    EXPECT_NEAR(model.rooms[0].volume_m3, 3.8 * 4 * 2.5, 1e-9);
    ASSERT_EQ(model.openings.size(), 1U);
    EXPECT_EQ(model.openings[0].room_a, 1);
    EXPECT_EQ(model.openings[0].room_b, 0);
    EXPECT_NEAR(model.openings[0].volume_m3, 0.9 * 2.05 * 0.2, 1e-9);
    EXPECT_NEAR(model.areas.ceiling, (3 + 3.8) * 4 + 0.9 * 0.2, 1e-9) << "the head counts";
    // 2 x 12 triangles of boxes; each pierced face 2 -> 7, no threshold's edge is kept: it is level with the
    // floor.
    EXPECT_LE(model.surface.mesh.triangles.size(), 44U);
  }
}

TEST(CutOpenings, EveryCellKnowsItsStoreyAndItsRoom) {
  const TwoRooms rooms;
  for (const auto& openings : {std::vector<Opening>{}, {rooms.door(1.7, 2.6, 2.05)}}) {
    const Model model = extract_model(rooms.complex, rooms.labels, openings, {});
    ASSERT_EQ(model.cell_rooms.room.size(), rooms.complex.cells());
    ASSERT_EQ(model.cell_rooms.storey.size(), rooms.complex.cells());
    std::vector<double> volume(model.rooms.size(), 0);
    for (std::size_t cell = 0; cell < rooms.complex.cells(); ++cell) {
      const bool empty = is_empty(rooms.labels.label, cell);
      EXPECT_EQ(model.cell_rooms.storey[cell], empty ? 0 : -1);
      EXPECT_EQ(model.cell_rooms.room[cell] >= 0, empty);
      if (empty) {
        volume.at(static_cast<std::size_t>(model.cell_rooms.room[cell])) += rooms.complex.volume(cell);
      }
    }
    for (std::size_t i = 0; i < volume.size(); ++i) {
      EXPECT_NEAR(volume[i], model.rooms[i].volume_m3, 1e-9) << "room " << i;
    }
  }
}

TEST(CutOpenings, TheRefinedComplexIsConforming) {
  const TwoRooms rooms;
  const OpenableComplex cut = cut_openings(
      rooms.complex, rooms.labels, {rooms.door(1.7, 2.6, 2.05, "o0001"), rooms.door(3.0, 3.9, 2.1, "o0002")});
  EXPECT_EQ(find_violation(cut.complex), "");
  EXPECT_EQ(cut.passages.size(), 2U);
  EXPECT_EQ(cut.complex.levels.size(), rooms.complex.levels.size() + 2);
  EXPECT_EQ(cut.labels.label.size(), cut.complex.cells());
}

TEST(CutOpenings, JambsOnEdgesOfThePlanAndHeadsAtLevelsNeedNoCut) {
  const TwoRooms rooms;
  for (const auto& [y0, y1, head] : {std::tuple(2.2, 3.0, 1.1), std::tuple(2.2, 2.9, 2.0)}) {
    const Model model = extract_model(rooms.complex, rooms.labels, {rooms.door(y0, y1, head)}, {});
    EXPECT_EQ(model.fault, "");
    if (model.refused.empty()) {
      EXPECT_NEAR(model.empty_m3, closed_m3(rooms) + (y1 - y0) * head * 0.2, 1e-9);
    } else {
      EXPECT_NEAR(model.empty_m3, closed_m3(rooms), 1e-9);
    }
  }
}

TEST(CutOpenings, ADoorUpToTheCeilingAndOneOverAnotherLevel) {
  const TwoRooms rooms;
  const Model model =
      extract_model(rooms.complex, rooms.labels,
                    {rooms.door(1.2, 2.0, 2.5, "o0001"), rooms.door(3.5, 4.5, 2.0, "o0002")}, {});
  EXPECT_EQ(model.fault, "");
  EXPECT_TRUE(model.refused.empty());
  EXPECT_NEAR(model.empty_m3, closed_m3(rooms) + (0.8 * 2.5 + 1.0 * 2.0) * 0.2, 1e-9);
  EXPECT_EQ(model.check.euler, 0) << "two doors between two rooms: one handle";
}

TEST(CutOpenings, APartThatTheCutHadEmptiedIsClosedAboveTheHead) {
  TwoRooms rooms;
  const double closed = closed_m3(rooms);
  for (std::size_t k = 0; k < rooms.complex.layers(); ++k) {  // the wall between y = 2.2 and 3 is gone
    for (std::size_t f = 0; f < rooms.complex.faces(); ++f) {
      const Vec2 p = rooms.complex.centroid(f);
      const double z = 0.5 * (rooms.complex.levels[k] + rooms.complex.levels[k + 1]);
      if (p.x() > 4 && p.x() < 4.2 && p.y() > 2.2 && p.y() < 3 && z > 0 && z < 2.5) {
        rooms.labels.label[rooms.complex.cell(f, k)] = Label::kEmpty;
      }
    }
  }
  ASSERT_NEAR(closed_m3(rooms), closed + 0.8 * 2.5 * 0.2, 1e-9);
  const Model model = extract_model(rooms.complex, rooms.labels, {rooms.door(2.0, 3.1, 2.0)}, {});
  EXPECT_EQ(model.fault, "");
  EXPECT_NEAR(model.empty_m3, closed + 1.1 * 2.0 * 0.2, 1e-9);
  EXPECT_EQ(model.rooms.size(), 2U) << "the rooms are those of the closed wall";
  ASSERT_EQ(model.openings.size(), 1U);
  EXPECT_NEAR(model.openings[0].volume_m3, model.empty_m3 - closed_m3(rooms), 1e-9);
  std::vector<int> found;  // rooms of the cells where the wall is gone, and of those beside them
  for (const Vec2& p : {Vec2(4.05, 2.6), Vec2(3, 2.6), Vec2(6, 2.6)}) {
    const auto cell = static_cast<std::size_t>(FaceLocator(rooms.complex).cell_at({p.x(), p.y(), 1}));
    EXPECT_EQ(model.cell_rooms.storey[cell], 0);
    found.push_back(model.cell_rooms.room[cell]);
  }
  EXPECT_EQ(found, (std::vector<int>{-1, 1, 0})) << "the door is no part of a room";
}

TEST(CutOpenings, WhatTheCutEmptiedBesideAJambIsClosedAsFarAsTwentyCentimetres) {
  for (const double jamb : {2.3, 2.5}) {  // the wall is gone from y = 2.2 on
    TwoRooms rooms;
    const double closed = closed_m3(rooms);
    for (std::size_t k = 0; k < rooms.complex.layers(); ++k) {
      for (std::size_t f = 0; f < rooms.complex.faces(); ++f) {
        const Vec2 p = rooms.complex.centroid(f);
        const double z = 0.5 * (rooms.complex.levels[k] + rooms.complex.levels[k + 1]);
        if (p.x() > 4 && p.x() < 4.2 && p.y() > 2.2 && p.y() < 3 && z > 0 && z < 2.5) {
          rooms.labels.label[rooms.complex.cell(f, k)] = Label::kEmpty;
        }
      }
    }
    const Model model = extract_model(rooms.complex, rooms.labels, {rooms.door(jamb, 3.1, 2.0)}, {});
    EXPECT_EQ(model.fault, "");
    ASSERT_EQ(model.openings.size(), jamb < 2.4 ? 1U : 0U);
    EXPECT_EQ(model.rooms.size(), jamb < 2.4 ? 2U : 1U);
    if (jamb < 2.4) {
      EXPECT_NEAR(model.empty_m3, closed + 0.8 * 2.0 * 0.2, 1e-9);
      EXPECT_NEAR(model.openings[0].volume_m3, model.empty_m3 - closed_m3(rooms), 1e-9);
    }
  }
}

TEST(CutOpenings, WhatDoesNotFitTheLabelsStaysClosedAndSaysWhy) {
  const TwoRooms rooms;
  Opening outside = rooms.door(1.5, 2.5, 2.0);
  outside.jamb_a.x() = outside.jamb_b.x() = 8.5;  // no room beyond
  Opening in_room = rooms.door(1.5, 2.5, 2.0);
  in_room.jamb_a.x() = in_room.jamb_b.x() = 6;
  Opening through_the_end = rooms.door(4.5, 5.5, 2.0);
  Opening too_high = rooms.door(1.5, 2.5, 2.8);
  Opening no_wall = rooms.door(1.5, 2.5, 2.0);
  no_wall.wall_a = "w77";
  for (const Opening& opening : {outside, in_room, through_the_end, too_high, no_wall}) {
    const Model model = extract_model(rooms.complex, rooms.labels, {opening}, {});
    EXPECT_EQ(model.fault, "");
    EXPECT_EQ(model.refused.size(), 1U);
    EXPECT_TRUE(model.openings.empty());
    EXPECT_NEAR(model.empty_m3, closed_m3(rooms), 1e-9);
  }
}

TEST(CutOpenings, WhateverIsGivenTheModelIsWatertight) {
  std::size_t opened = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    std::uint64_t count = 0;
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * random_unit(seed, 1, count++);
    };
    const TwoRooms rooms(uniform(0, 3));
    std::vector<Opening> openings;
    for (int i = 0; i < 4; ++i) {  // they overlap, touch, leave the wall
      const double y = std::round(uniform(0.5, 5) * 5) / 5;
      openings.push_back(
          rooms.door(y, y + std::round(uniform(0.2, 2) * 5) / 5, uniform(0.5, 3), "o" + std::to_string(i)));
      openings.back().sill_z = i % 2 == 0 ? 0 : uniform(0, 0.4);
    }
    const Model model = extract_model(rooms.complex, rooms.labels, openings, {});
    EXPECT_EQ(model.fault, "") << "seed " << seed;
    EXPECT_EQ(model.openings.size() + model.refused.size(), openings.size());
    double sum = closed_m3(rooms);
    for (const ModelOpening& opening : model.openings) {
      sum += opening.volume_m3;
    }
    EXPECT_NEAR(model.empty_m3, sum, 1e-9) << "seed " << seed;
    opened += model.openings.size();
  }
  EXPECT_GT(opened, 60U);
}

}  // namespace
}  // namespace roomcut::extract
