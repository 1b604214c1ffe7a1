// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/raycast.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "stages/raycast/cell_evidence.h"
#include "tests/unit/raycast/room_weights.h"
#include "tests/unit/weigh_faces/grid_complex.h"

namespace roomcut::raycast {
using namespace roomcut::weigh_faces;

namespace {

struct Cube {
  CellComplex complex = grid_complex({-2, 0, 3, 5}, {-2, 0, 3, 5}, {-1, 0, 3, 4});
  std::size_t room = complex.cell(4, 1);
  std::vector<bool> empty = [this] {
    std::vector<bool> e(complex.cells(), false);
    e[room] = true;
    return e;
  }();
  FaceWeights weights = weights_of(complex, empty);
};

TEST(CastRays, ACubeIsEmptyInsideAndSolidOutsideByEveryEvidence) {
  const Cube cube;
  const DataTerms t = cast_rays(cube.complex, cube.weights, {});
  EXPECT_EQ(t.kappa[cube.room], 1) << "a ray from an empty cell crosses an odd number of permanent faces";
  EXPECT_NEAR(t.winding[cube.room], 1, 1e-6);
  EXPECT_NEAR(t.around[cube.room], 1, 1e-6);
  EXPECT_NEAR(t.vertical[cube.room], 1, 1e-6);
  EXPECT_NEAR(t.surface_m2[cube.room], 6 * 9.0, 1e-4);
  EXPECT_GT(t.beta[cube.room], 0.95);
  for (std::size_t c = 0; c < cube.complex.cells(); ++c) {
    if (c != cube.room) {
      EXPECT_EQ(t.kappa[c], 0) << c;
      EXPECT_NEAR(t.winding[c], 0, 1e-6) << c;
      EXPECT_LE(t.around[c], 0) << c;
      EXPECT_LE(t.vertical[c], 0) << c;
      EXPECT_LE(t.surface_m2[c], 0) << c;
      EXPECT_LT(t.beta[c], 0.3) << c;
    }
  }
}

TEST(CastRays, SixtyFourRaysSayWhatThousandsSay) {
  const Cube cube;
  RaycastParams thousands;
  thousands.rays = 4096;
  const DataTerms few = cast_rays(cube.complex, cube.weights, {});
  const DataTerms many = cast_rays(cube.complex, cube.weights, thousands);
  for (std::size_t c = 0; c < cube.complex.cells(); ++c) {
    EXPECT_NEAR(few.beta[c], many.beta[c], 0.015) << c;
  }
}

/// The same complex with its faces numbered from the other end, and their corners from the next one.
CellComplex renumbered(const CellComplex& complex) {
  CellComplex other = complex;
  const auto faces = static_cast<std::int32_t>(complex.faces());
  const auto number = [&](std::int32_t face) { return face < 0 ? face : faces - 1 - face; };
  for (CellComplex::Edge& edge : other.edges) {
    edge.left = number(edge.left);
    edge.right = number(edge.right);
  }
  other.face_offset = {0};
  other.face_vertex.clear();
  other.face_edge.clear();
  for (std::int32_t face = faces - 1; face >= 0; --face) {
    const auto vertices = complex.vertices_of(static_cast<std::size_t>(face));
    const auto edges = complex.edges_of(static_cast<std::size_t>(face));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      other.face_vertex.push_back(vertices[(i + 1) % vertices.size()]);
      other.face_edge.push_back(edges[(i + 1) % edges.size()]);
    }
    other.face_offset.push_back(static_cast<std::int64_t>(other.face_vertex.size()));
  }
  return other;
}

TEST(CastRays, ACellIsAskedByTheSameRaysWhateverItsNumber) {
  const Cube cube;
  const CellComplex other = renumbered(cube.complex);
  const std::size_t faces = other.faces();
  std::vector<bool> empty(other.cells(), false);
  empty[other.cell(faces - 1 - 4, 1)] = true;
  const DataTerms a = cast_rays(cube.complex, cube.weights, {});
  const DataTerms b = cast_rays(other, weights_of(other, empty), {});
  for (std::size_t face = 0; face < faces; ++face) {
    for (std::size_t layer = 0; layer < other.layers(); ++layer) {
      const std::size_t at = cube.complex.cell(face, layer);
      EXPECT_NEAR(a.beta[at], b.beta[other.cell(faces - 1 - face, layer)], 1e-5) << at;
      EXPECT_NEAR(a.around[at], b.around[other.cell(faces - 1 - face, layer)], 1e-5) << at;
    }
  }
}

TEST(CastRays, ThePapersDataTermFollowsFromParityAlone) {
  const Cube cube;
  RaycastParams params;
  params.evidence = "parity";
  const DataTerms t = cast_rays(cube.complex, cube.weights, params);
  EXPECT_NEAR(t.beta[cube.room], 1 / (1 + std::exp(-5.0)), 1e-6);
  EXPECT_NEAR(t.d_solid[cube.room], 27 * t.beta[cube.room], 1e-5);
  EXPECT_NEAR(t.d_empty[cube.room], 27 * (1 - t.beta[cube.room]), 1e-5);
}

/// Two rooms of 4 × 4 × 2.6 m with a wall of 10 cm between them.
struct TwoRooms {
  CellComplex complex = grid_complex({-2, 0, 4, 4.1, 8.1, 10}, {-2, 0, 4, 6}, {-0.5, 0, 2.6, 3.1});
  std::size_t west = complex.cell(6, 1), wall = complex.cell(7, 1), east = complex.cell(8, 1);
  std::vector<bool> empty = [this] {
    std::vector<bool> e(complex.cells(), false);
    e[west] = e[east] = true;
    return e;
  }();
  FaceWeights weights = weights_of(complex, empty);
};

TEST(CastRays, AThinWallBetweenTwoRoomsIsSolid) {
  const TwoRooms scene;
  const DataTerms t = cast_rays(scene.complex, scene.weights, {});
  EXPECT_LT(t.beta[scene.wall], 0.3);
  EXPECT_LT(t.around[scene.wall], -0.9);
  EXPECT_GT(t.beta[scene.west], 0.7);
  EXPECT_GT(t.beta[scene.east], 0.7);
  EXPECT_GT(t.d_empty[scene.wall] - t.d_solid[scene.wall], 1.0)
      << "its two faces speak for 10.4 m² of wall each, more than its volume of 1 m³";
}

TEST(CastRays, AThinWallStaysSolidWhenFloorAndCeilingSpillOverIt) {
  TwoRooms scene;
  const std::size_t plan = 7;
  scene.weights.level_omega[scene.complex.level_face(plan, 1)] = 0.6F;
  scene.weights.level_floor[scene.complex.level_face(plan, 1)] = 0.6F;
  scene.weights.level_omega[scene.complex.level_face(plan, 2)] = 0.6F;
  scene.weights.level_ceiling[scene.complex.level_face(plan, 2)] = 0.6F;
  const DataTerms t = cast_rays(scene.complex, scene.weights, {});
  EXPECT_GT(t.d_empty[scene.wall], t.d_solid[scene.wall]);
}

TEST(CastRays, AMissingCeilingLeavesTheRoomEmpty) {
  Cube cube;
  cube.weights.level_omega[cube.complex.level_face(4, 2)] = 0;
  cube.weights.level_ceiling[cube.complex.level_face(4, 2)] = 0;
  const DataTerms t = cast_rays(cube.complex, cube.weights, {});
  EXPECT_GT(t.beta[cube.room], 0.7);
  EXPECT_LT(t.beta[cube.complex.cell(3, 1)], 0.3) << "beside the room";
}

TEST(CastRays, AWallThatIsHalfWindowLeavesTheRoomEmptyAndTheOutsideSolid) {
  Cube cube;
  const std::size_t face = cube.complex.wall_face(edge_near(cube.complex, {0, 1.5}), 1);
  cube.weights.wall_omega[face] = 0.5F;
  cube.weights.wall_left[face] *= 0.5F;
  cube.weights.wall_right[face] *= 0.5F;
  const DataTerms t = cast_rays(cube.complex, cube.weights, {});
  EXPECT_GT(t.beta[cube.room], 0.8);
  EXPECT_LT(t.beta[cube.complex.cell(3, 1)], 0.3) << "before the window";
}

TEST(CastRays, AWallOfWhichOneFaceWasNotSeenKeepsBothRooms) {
  TwoRooms scene;
  const std::size_t face = scene.complex.wall_face(edge_near(scene.complex, {4.1, 2}), 1);
  scene.weights.wall_omega[face] = scene.weights.wall_left[face] = scene.weights.wall_right[face] = 0;
  const DataTerms t = cast_rays(scene.complex, scene.weights, {});
  EXPECT_GT(t.beta[scene.west], 0.7);
  EXPECT_GT(t.beta[scene.east], 0.7);
}

/// A wall of 20 cm seen from the west only; a line of another storey splits it 4 cm behind its face.
struct SplitWall {
  CellComplex complex = grid_complex({-2, 0, 4, 4.04, 4.2, 8.2, 10}, {-2, 0, 4, 6}, {-0.5, 0, 2.6, 3.1});
  std::size_t behind = complex.cell(9, 1);
  FaceWeights weights = [this] {
    std::vector<bool> empty(complex.cells(), false);
    empty[complex.cell(7, 1)] = empty[complex.cell(10, 1)] = true;
    FaceWeights w = weights_of(complex, empty);
    const std::size_t unseen = complex.wall_face(edge_near(complex, {4.2, 2}), 1);
    w.wall_omega[unseen] = w.wall_left[unseen] = w.wall_right[unseen] = 0;
    return w;
  }();
};

TEST(CastRays, AWallSeenFromOneSideIsSolidBeyondALineInsideIt) {
  const SplitWall wall;
  EXPECT_LT(cast_rays(wall.complex, wall.weights, {}).beta[wall.behind], 0.5);
}

TEST(CastRays, ARoomsRimBehindACupboardHasACeilingAndIsEmpty) {
  SplitWall cupboard;
  cupboard.weights.level_omega[cupboard.complex.level_face(9, 2)] = 1;
  cupboard.weights.level_ceiling[cupboard.complex.level_face(9, 2)] = 1;
  EXPECT_GT(cast_rays(cupboard.complex, cupboard.weights, {}).beta[cupboard.behind], 0.5);
}

TEST(CastRays, TheUnseenFaceOfAWallIsImpliedByTheSeenOne) {
  TwoRooms scene;
  const std::size_t unseen = scene.complex.wall_face(edge_near(scene.complex, {4.1, 2}), 1);
  scene.weights.wall_omega[unseen] = scene.weights.wall_left[unseen] = scene.weights.wall_right[unseen] = 0;
  const DataTerms t = cast_rays(scene.complex, scene.weights, {});
  EXPECT_GT(t.wall_implied[unseen], 0.89);
  EXPECT_EQ(t.wall_implied[scene.complex.wall_face(edge_near(scene.complex, {8.1, 2}), 1)], 0)
      << "4 m from the next wall that shows it its back";
  EXPECT_GT(t.d_empty[scene.wall], t.d_solid[scene.wall]);
}

TEST(CastRays, ATerraceBeforeARoomIsNoRoom) {
  TwoRooms scene;  // of the eastern one only the floor and the wall to the other room are left
  FaceWeights& weights = scene.weights;
  for (const Vec2& middle : {Vec2(8.1, 2), Vec2(6, 0), Vec2(6, 4)}) {
    const std::size_t w = scene.complex.wall_face(edge_near(scene.complex, middle), 1);
    weights.wall_omega[w] = weights.wall_left[w] = weights.wall_right[w] = 0;
  }
  const std::size_t ceiling = scene.complex.level_face(8, 2);
  weights.level_omega[ceiling] = weights.level_ceiling[ceiling] = 0;
  const DataTerms t = cast_rays(scene.complex, weights, {});
  EXPECT_LT(t.beta[scene.east], 0.5);
  EXPECT_GT(t.beta[scene.west], 0.7);
  EXPECT_GT(feature(t, "open")[scene.east], 0.3);
}

TEST(CastRays, ARoomNotEnteredButSeenThroughItsDoorIsEmpty) {
  // Walls of the neighbours show it their backs on three sides, a fourth its front; a third of its floor was
  // seen.
  Cube cube;
  FaceWeights weights = cube.weights;
  for (const Vec2& middle : {Vec2(0, 1.5), Vec2(3, 1.5), Vec2(1.5, 0)}) {
    const std::size_t w = cube.complex.wall_face(edge_near(cube.complex, middle), 1);
    std::swap(weights.wall_left[w], weights.wall_right[w]);
  }
  const std::size_t floor = cube.complex.level_face(4, 1);
  const std::size_t ceiling = cube.complex.level_face(4, 2);
  weights.level_omega[floor] = weights.level_floor[floor] = 0.33F;
  weights.level_omega[ceiling] = weights.level_ceiling[ceiling] = 0;
  EXPECT_GT(cast_rays(cube.complex, weights, {}).beta[cube.room], 0.5);
}

TEST(CastRays, AScannersLineOfSightSpeaksForEmptySpace) {
  TwoRooms scene;
  scene.weights.stations = {Vec3(1, 1, 1.5), Vec3(1e4, 0, 0)};
  const DataTerms t = cast_rays(scene.complex, scene.weights, {});
  EXPECT_GT(t.line_of_sight[scene.west], 0.85);
  EXPECT_LT(t.line_of_sight[scene.wall], 0.01);
  EXPECT_LT(t.line_of_sight[scene.east], 0.01);
  TwoRooms without;
  EXPECT_GT(t.beta[scene.west], cast_rays(without.complex, without.weights, {}).beta[scene.west]);
}

TEST(CastRays, NothingIsKnownWhereNothingWasSeen) {
  const Cube cube;
  const DataTerms t = cast_rays(cube.complex, no_weights(cube.complex), {});
  for (std::size_t c = 0; c < cube.complex.cells(); ++c) {
    EXPECT_EQ(t.observed[c], 0);
    EXPECT_LT(t.beta[c], 0.5);
  }
}

TEST(CastRays, OneThreadAndFourGiveTheSameBytes) {
  const TwoRooms scene;
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return cast_rays(scene.complex, scene.weights, {});
  };
  const DataTerms one = run(1);
  const DataTerms four = run(4);
  EXPECT_EQ(one.kappa, four.kappa);
  EXPECT_EQ(one.around, four.around);
  EXPECT_EQ(one.winding, four.winding);
  EXPECT_EQ(one.beta, four.beta);
  EXPECT_EQ(one.d_empty, four.d_empty);
  EXPECT_EQ(one.d_solid, four.d_solid);
}

TEST(LookedThrough, CountsForRoomsAndTheirRimsNotForWallsAndSlabs) {
  const auto counts = [](double width, double height, double carved) {
    CellEvidence e;
    e.volume_m3 = width * 4 * height;
    e.total_m2 = 2 * (width * 4 + (width + 4) * height);
    e.height_m = height;
    e.carved = carved;
    return e.looked_through();
  };
  EXPECT_NEAR(counts(3, 2.5, 0.5), 0.5, 0.01) << "a room";
  EXPECT_EQ(counts(0.15, 2.5, 0.2), 0) << "a wall, through a door";
  EXPECT_GT(counts(0.15, 2.5, 0.7), 0.7) << "a rim behind a cupboard";
  EXPECT_EQ(counts(3, 0.2, 0.7), 0) << "a slab, through a stair's hole";
  CellEvidence garden;
  garden.volume_m3 = 30;
  garden.total_m2 = 60;
  garden.height_m = 2.5;
  garden.carved = 0.9;
  garden.upright.both_open = 1;
  EXPECT_EQ(garden.looked_through(), 0) << "nothing above, nothing below";
}

}  // namespace
}  // namespace roomcut::raycast
