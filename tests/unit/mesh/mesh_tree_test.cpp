// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/mesh/mesh_tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/mesh/nearest_triangles.h"
#include "common/random/counter_random.h"
#include "tests/unit/mesh/shapes.h"

namespace roomcut {
namespace {

using test::append;
using test::box;

Vec3 random_point(std::uint64_t stream, std::uint64_t i, double scale) {
  return scale * Vec3(random_unit(1, stream, 3 * i), random_unit(1, stream, 3 * i + 1),
                      random_unit(1, stream, 3 * i + 2));
}

TriangleMesh random_triangles(std::int32_t count) {
  TriangleMesh mesh;
  for (std::int32_t i = 0; i < count; ++i) {
    const auto counter = static_cast<std::uint64_t>(i);
    const Vec3 centre = random_point(1, counter, 10);
    for (std::uint64_t c = 0; c < 3; ++c) {
      mesh.vertices.emplace_back(centre + random_point(2, 3 * counter + c, 1));
    }
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

// Least distance over a fine grid of barycentric coordinates: an upper bound, tight to the grid's step.
double sampled_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  double best = MeshTree::kInfinity;
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      best = std::min(best, (a + (b - a) * i / kSteps + (c - a) * j / kSteps - p).norm());
    }
  }
  return best;
}

TEST(MeshTree, DistanceToATriangleAgreesWithDenseSampling) {
  for (std::uint64_t i = 0; i < 60; ++i) {
    const Vec3 a = random_point(5, 4 * i, 1), b = random_point(5, 4 * i + 1, 1),
               c = random_point(5, 4 * i + 2, 1);
    const Vec3 p = 2 * random_point(5, 4 * i + 3, 1);
    const double exact = std::sqrt(squared_distance(p, a, b, c));
    const double sampled = sampled_distance(p, a, b, c);
    EXPECT_LE(exact, sampled + 1e-12);
    EXPECT_GT(exact, sampled - 0.01);
  }
}

TEST(MeshTree, NearestEqualsTheBruteForceWithAndWithoutHint) {
  const TriangleMesh mesh = random_triangles(300);
  const MeshTree tree(mesh);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Vec3 p = random_point(3, i, 12);
    double best = MeshTree::kInfinity;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      best = std::min(best, squared_distance(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)));
    }
    const MeshTree::Hit hit = tree.nearest(p);
    EXPECT_DOUBLE_EQ(hit.distance, std::sqrt(best));
    const MeshTree::Hit hinted = tree.nearest(p, MeshTree::kInfinity, static_cast<std::int32_t>(i));
    EXPECT_EQ(hinted.triangle, hit.triangle);
    EXPECT_EQ(tree.nearest(p, 0.5 * hit.distance).triangle, -1);
  }
}

TEST(MeshTree, NearestFacingPassesOverTheOtherSideOfAThinWall) {
  TriangleMesh mesh = box({0, 0, 0}, {4, 4, 3});
  append(mesh, box({4.1, 0, 0}, {8, 4, 3}));
  const MeshTree tree(mesh);
  const Vec3 p(4.02, 2, 1.5);
  EXPECT_NEAR(tree.nearest(p).distance, 0.02, 1e-12);
  const auto facing = tree.nearest_facing(p, 1, Vec3(-1, 0, 0), 0.9);
  EXPECT_NEAR(facing.distance, 0.08, 1e-12);
  EXPECT_EQ(tree.nearest_facing(p, 0.05, Vec3(-1, 0, 0), 0.9).triangle, -1);
}

TEST(MeshTree, RaysStopAtTheFirstTriangleWithinTheirLimits) {
  TriangleMesh mesh = box({0, 0, 0}, {4, 4, 3});
  append(mesh, box({4.1, 0, 0}, {8, 4, 3}));
  const MeshTree tree(mesh);
  const Vec3 on_wall(4, 1.7, 1.1);
  const Vec3 east(1, 0, 0);
  const auto hit = tree.first_on_ray(on_wall, east, 1e-6, 0.4);
  ASSERT_GE(hit.triangle, 12);
  EXPECT_NEAR(hit.distance, 0.1, 1e-12);
  EXPECT_EQ(tree.first_on_ray(on_wall, east, 1e-6, 0.05).triangle, -1);
  EXPECT_EQ(tree.first_on_ray({2, 2, 5}, east, 0, 100).triangle, -1);
  EXPECT_NEAR(tree.first_on_ray({2, 2, 3}, east, 0, 100).distance, 2,
              1e-12);  // along the ceiling, in its plane
  EXPECT_NEAR(tree.first_on_ray({2, 2, 1}, -east, 0, 100).distance, 2, 1e-12);
}

TEST(MeshTree, TheFirstOnARayEqualsTheBruteForce) {
  TriangleMesh mesh = random_triangles(300);
  append(mesh, box({2, 2, 2}, {6, 7, 4}));
  const MeshTree tree(mesh);
  std::vector<MeshTree> single;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t) {
    single.emplace_back(mesh, std::vector<std::int32_t>{t});
  }
  int hits = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Vec3 from = random_point(6, i, 10);
    Vec3 unit = random_point(7, i, 2) - Vec3(1, 1, 1);
    for (int axis = 0; axis < 3; ++axis) {  // some level, upright, along an axis
      if (i % 8 >= 4 && (i >> axis & 1U) != 0) unit[axis] = 0;
    }
    if (unit.isZero()) continue;
    unit.normalize();
    const double farthest = i % 3 == 0 ? 2 : 20;
    MeshTree::Hit best;
    for (const MeshTree& triangle : single) {
      const MeshTree::Hit one = triangle.first_on_ray(from, unit, 0.01, farthest);
      if (one.distance < best.distance) best = one;
    }
    const MeshTree::Hit hit = tree.first_on_ray(from, unit, 0.01, farthest);
    EXPECT_EQ(hit.triangle, best.triangle) << i;
    EXPECT_EQ(hit.distance, best.distance) << i;
    hits += hit.triangle >= 0 ? 1 : 0;
  }
  EXPECT_GT(hits, 100);
}

TEST(MeshTree, AnswersTheSameForManyTrianglesInOnePlace) {
  TriangleMesh mesh;  // their middles coincide: no plane parts them
  for (std::int32_t i = 0; i < 3000; ++i) {
    const double size = 1 + 1e-3 * i;
    mesh.vertices.insert(mesh.vertices.end(),
                         {Vec3(-size, -size, 0), Vec3(size, -size, 0), Vec3(0, size, 0)});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const MeshTree tree(mesh);
  const auto hit = tree.first_on_ray({0, 0, 1}, {0, 0, -1}, 0, 5);
  EXPECT_DOUBLE_EQ(hit.distance, 1);
  EXPECT_DOUBLE_EQ(tree.nearest({0, 0, -2}).distance, 2);
}

TEST(MeshTree, AnEmptySubsetAnswersWithNothing) {
  const TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  const MeshTree tree(mesh, {});
  EXPECT_TRUE(tree.empty());
  EXPECT_EQ(tree.nearest({0, 0, 0}).triangle, -1);
}

TEST(NearestTriangles, of_many_points_at_once_are_those_of_one_after_the_other) {
  TriangleMesh mesh = random_triangles(300);
  append(mesh, box({2, 2, 2}, {6, 7, 4}));  // points on a side of it have two triangles at the same distance
  const MeshTree tree(mesh);
  std::vector<Vec3> points;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    points.push_back(random_point(3, i, 12));
    points.push_back({2 + 4 * random_unit(1, 4, 2 * i), 2 + 5 * random_unit(1, 4, 2 * i + 1), 2});
    points.push_back({2 + 0.001 * static_cast<double>(i), 2, 2});
  }
  for (const double limit : {0.25, 2.0, MeshTree::kInfinity}) {
    const std::vector<MeshTree::Hit> hits = nearest_triangles(mesh, points, limit);
    ASSERT_EQ(hits.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const MeshTree::Hit one = tree.nearest(points[i], limit);
      EXPECT_EQ(hits[i].triangle, one.triangle);
      EXPECT_EQ(hits[i].distance, one.distance);
    }
  }
}

TEST(NearestTriangles, without_triangles_or_points_there_are_none) {
  EXPECT_EQ(nearest_triangles({}, {{0, 0, 0}}, 1).front().triangle, -1);
  EXPECT_TRUE(nearest_triangles(box({0, 0, 0}, {1, 1, 1}), {}, 1).empty());
}

}  // namespace
}  // namespace roomcut
