// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/find_openings/find_openings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/unit/find_openings/made_wall.h"

namespace roomcut::find_openings {
namespace {

using test::MadeWall;
using test::Patch;

constexpr Patch kDoor{2.0, 2.9, 0, 2.05};

/// The one opening that was found is kDoor to `tolerance`.
void expect_door(const MadeWall& wall, const std::vector<Opening>& found, double tolerance) {
  ASSERT_EQ(found.size(), 1U);
  const auto [y0, y1] = std::minmax({wall.y_of(found[0].jamb_a), wall.y_of(found[0].jamb_b)});
  EXPECT_NEAR(y0, kDoor.y0, tolerance);
  EXPECT_NEAR(y1, kDoor.y1, tolerance);
  EXPECT_NEAR(found[0].head_z, kDoor.z1, tolerance);
  EXPECT_EQ(found[0].sill_z, 0);
  EXPECT_NEAR(found[0].thickness_m, wall.thickness, 1e-9);
}

TEST(FindOpenings, ADoorwayWithinFiveMillimetres) {
  for (const double noise : {0.003, 0.005, 0.01}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      MadeWall wall;
      wall.noise_m = noise;
      wall.seed = seed;
      wall.angle = 0.3 * static_cast<double>(seed);
      wall.faces({kDoor}, {kDoor});
      wall.doorway(kDoor);
      SCOPED_TRACE(testing::Message() << "noise " << noise << ", seed " << seed);
      expect_door(wall, wall.search(), 0.005);
    }
  }
}

TEST(FindOpenings, APassageWiderThanADoor) {
  const Patch passage{0.7, 4.3, 0, 2.3};
  MadeWall wall;
  wall.faces({passage}, {passage});
  wall.doorway(passage);
  const std::vector<Opening> found = wall.search();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR((found[0].jamb_a - found[0].jamb_b).norm(), 3.6, 0.01);
  EXPECT_NEAR(found[0].head_z, passage.z1, 0.01);
}

TEST(FindOpenings, ADoorwayThatTheCutHasEmptiedInPart) {
  for (const Patch& gap : {Patch{2.3, 2.5, 0, 2.6}, Patch{2.1, 2.85, 0, 2.6}}) {
    MadeWall wall;
    wall.gap = gap;
    wall.faces({kDoor}, {kDoor});
    wall.doorway(kDoor);
    expect_door(wall, wall.search(), 0.005);
  }
}

TEST(FindOpenings, WhereTwoWallsEndBesideACorridorIsNone) {
  MadeWall wall;
  const Patch corridor{2.0, 2.9, 0, 2.6};
  wall.gap = corridor;
  wall.faces({corridor}, {corridor});
  wall.doorway(corridor);
  EXPECT_TRUE(wall.search().empty());
}

TEST(FindOpenings, AlsoWithFewPoints) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    MadeWall sparse;
    sparse.density = 200;
    sparse.seed = seed;
    sparse.faces({kDoor}, {kDoor});
    sparse.doorway(kDoor);
    expect_door(sparse, sparse.search(), 0.005);
  }
}

// Noise puts points of both faces all over the inside of such a wall. Some doors may be given up, none may be
// wrong.
TEST(FindOpenings, TwoCentimetresOfNoiseInAWallOfTen) {
  std::size_t doors = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    MadeWall noisy;
    noisy.noise_m = 0.02;
    noisy.thickness = 0.1;
    noisy.seed = seed;
    noisy.faces({kDoor}, {kDoor});
    noisy.doorway(kDoor);
    const auto found = noisy.search();
    doors += found.size();
    if (!found.empty()) {
      expect_door(noisy, found, 0.02);
    }
  }
  EXPECT_GE(doors, 8U);
}

TEST(FindOpenings, AnOpeningUpToTheCeilingEndsThere) {
  MadeWall wall;
  const Patch passage{1, 2.5, 0, 2.6};
  wall.faces({passage}, {passage});
  wall.doorway(passage);
  const auto found = wall.search();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].head_z, 2.6);
}

TEST(FindOpenings, TwoDoorsSideBySideAreTwo) {
  MadeWall wall;
  const Patch other{3.0, 3.8, 0, 2.05};
  wall.faces({kDoor, other}, {kDoor, other});
  wall.doorway(kDoor);
  wall.doorway(other);
  const auto found = wall.search();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].id, "o0001");
  EXPECT_EQ(found[1].id, "o0002");
  EXPECT_EQ(found[0].head_z, found[1].head_z) << "within noise: one height";
}

TEST(FindOpenings, AWardrobeBeforeAWallIsNone) {
  MadeWall one_side;
  one_side.faces({kDoor}, {});
  one_side.panel(-0.6, kDoor);
  EXPECT_TRUE(one_side.search().empty());
  MadeWall both_sides;
  both_sides.faces({kDoor}, {kDoor});
  both_sides.panel(-0.6, kDoor);
  both_sides.panel(0.7, kDoor);
  EXPECT_TRUE(both_sides.search().empty());
}

TEST(FindOpenings, AWindowBetweenRoomsIsNone) {
  MadeWall wall;
  const Patch window{2.0, 2.9, 0.9, 2.05};
  wall.faces({window}, {window});
  wall.doorway(window);
  EXPECT_TRUE(wall.search().empty());
}

TEST(FindOpenings, AClosedDoorIsNoneWhereverTheLeafHangs) {
  for (const double depth : {0.0, 0.03, 0.06, 0.09, 0.12}) {
    MadeWall wall;
    wall.faces({kDoor}, {kDoor});
    wall.doorway(kDoor);
    wall.panel(depth, kDoor);
    EXPECT_TRUE(wall.search().empty()) << depth;
  }
}

TEST(FindOpenings, ANicheAndABookcaseInTheWallAreNone) {
  MadeWall niche;
  niche.thickness = 0.3;
  niche.faces({kDoor}, {});
  niche.jamb(kDoor.y0, 0, kDoor.z1, 0, 0.6);
  niche.jamb(kDoor.y1, 0, kDoor.z1, 0, 0.6);
  niche.level(kDoor.z1, kDoor.y0, kDoor.y1);
  niche.panel(0.2, kDoor);
  EXPECT_TRUE(niche.search().empty());
}

TEST(FindOpenings, EvidenceInPartMakesNone) {
  const auto wall_with = [](bool first, bool second, bool head, double covered_up_to) {
    MadeWall wall;
    const Patch hole{kDoor.y0, kDoor.y1, covered_up_to, kDoor.z1};
    wall.faces({hole}, {kDoor});
    if (first) wall.jamb(kDoor.y0, 0, kDoor.z1);
    if (second) wall.jamb(kDoor.y1, 0, kDoor.z1);
    if (head) wall.level(kDoor.z1, kDoor.y0, kDoor.y1);
    return wall.search().size();
  };
  EXPECT_EQ(wall_with(true, true, true, 0), 1U);
  EXPECT_EQ(wall_with(false, true, true, 0), 0U);
  EXPECT_EQ(wall_with(true, false, true, 0), 0U);
  EXPECT_EQ(wall_with(true, true, false, 0), 0U);
  EXPECT_EQ(wall_with(true, true, true, 0.8), 0U) << "one face covered up to the height of a parapet";
}

TEST(FindOpenings, AJambSeenInItsLowerThirdOnlyIsNone) {
  MadeWall wall;
  wall.faces({kDoor}, {kDoor});
  wall.jamb(kDoor.y0, 0, 0.6);
  wall.jamb(kDoor.y1, 0, kDoor.z1);
  wall.level(kDoor.z1, kDoor.y0, kDoor.y1);
  EXPECT_TRUE(wall.search().empty());
}

TEST(FindOpenings, AWallThatEndsAtTheJambIsNone) {
  MadeWall wall;  // no points on either face beyond y = 2.9: that may be anything
  const Patch gone{kDoor.y0, 5, 0, 2.6};
  wall.faces({gone}, {gone});
  wall.doorway(kDoor);
  EXPECT_TRUE(wall.search().empty());
}

TEST(FindOpenings, TheOrderOfThePointsMeansNothing) {
  MadeWall wall;
  wall.faces({kDoor}, {kDoor});
  wall.doorway(kDoor);
  const auto forward = wall.search();
  for (auto* values : {&wall.tile().x, &wall.tile().y, &wall.tile().z}) {
    std::reverse(values->begin(), values->end());
  }
  const auto backward = wall.search();
  ASSERT_EQ(forward.size(), 1U);
  ASSERT_EQ(backward.size(), 1U);
  EXPECT_EQ(forward[0].jamb_a, backward[0].jamb_a);
  EXPECT_EQ(forward[0].jamb_b, backward[0].jamb_b);
  EXPECT_EQ(forward[0].head_z, backward[0].head_z);
}

TEST(JoinHeads, OnlyWhatNoiseExplainsBecomesOne) {
  std::vector<Opening> openings(4);
  const std::vector<double> heads{2.001, 2.000, 2.010, 2.6};
  for (std::size_t i = 0; i < 4; ++i) {
    openings[i].head_z = heads[i];
    openings[i].proof_head = {100, 1, 0.0005};
  }
  join_heads(openings, {0, 2.6});
  EXPECT_EQ(openings[0].head_z, openings[1].head_z);
  EXPECT_NEAR(openings[0].head_z, 2.0005, 1e-12);
  EXPECT_EQ(openings[2].head_z, 2.010);
  EXPECT_EQ(openings[3].head_z, 2.6) << "at a ceiling";
}

}  // namespace
}  // namespace roomcut::find_openings
