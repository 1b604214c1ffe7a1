// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "stages/tools/synthesize/holes.h"
#include "tests/unit/synthesize/test_scenes.h"

namespace roomcut::synthesize {
using namespace roomcut::test;

namespace {

using nlohmann::json;

const Vec3 kLo(0, 0, 0);
const Vec3 kHi(4, 3, 2.5);

Vec3 at(const std::vector<float>& xyz, std::size_t i) {
  return {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
}

json sampling(std::uint64_t points) {
  return {{"sampling", {{"kind", "uniform"}, {"points", points}}}};
}

TEST(UniformScan, HasExactlyTheWantedPointsOnTheSurface) {
  const auto xyz = test::all_points(test::box_scene(sampling(70001)));
  ASSERT_EQ(xyz.size(), 3U * 70001);
  for (std::size_t i = 0; i < xyz.size() / 3; ++i)
    ASSERT_LT(std::abs(test::box_distance(at(xyz, i), kLo, kHi)), 1e-6);
}

TEST(UniformScan, IsSpreadEvenlyOverTheSurface) {
  const std::size_t n = 100000;
  const auto xyz = test::all_points(test::box_scene(sampling(n)));
  const double area = 2 * (12 + 10 + 7.5);
  std::array<int, 12> floor{};  // square metres of the floor
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = at(xyz, i);
    if (p.z() < 1e-6)
      ++floor[static_cast<int>(std::min(p.y(), 2.999)) * 4 + static_cast<int>(std::min(p.x(), 3.999))];
  }
  for (const int count : floor) EXPECT_NEAR(count, n / area, 5 * std::sqrt(n / area));
}

TEST(UniformScan, NoiseHasTheWantedDeviationAndNoBias) {
  json more = sampling(100000);
  more["noise_m"] = 0.01;
  const auto xyz = test::all_points(test::box_scene(more));
  double sum = 0;
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Vec3 p = at(xyz, i);
    ASSERT_LT(std::abs(test::box_distance(p, kLo, kHi)), 0.06);
    if (p.x() < 0.2 || p.x() > 3.8 || p.y() < 0.2 || p.y() > 2.8 || p.z() > 1) continue;
    sum += p.z();
    squares += p.z() * p.z();
    ++count;
  }
  EXPECT_NEAR(sum / count, 0, 4 * 0.01 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), 0.01, 4 * 0.01 / std::sqrt(2.0 * count));
}

TEST(UniformScan, SameSeedSamePointsAnotherSeedOthers) {
  json more = sampling(5000);
  more["noise_m"] = 0.01;
  const auto first = test::all_points(test::box_scene(more));
  EXPECT_EQ(first, test::all_points(test::box_scene(more)));
  more["seed"] = 2;
  EXPECT_NE(first, test::all_points(test::box_scene(more)));
}

TEST(UniformScan, ShufflingPermutesTheSamePoints) {
  json more = sampling(5000);
  const auto ordered = test::all_points(test::box_scene(more));
  more["sampling"]["order"] = "shuffled";
  const auto shuffled = test::all_points(test::box_scene(more));
  EXPECT_NE(ordered, shuffled);
  const auto sorted = [](const std::vector<float>& xyz) {
    std::vector<std::array<float, 3>> points;
    for (std::size_t i = 0; i < xyz.size(); i += 3) points.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
    std::sort(points.begin(), points.end());
    return points;
  };
  EXPECT_EQ(sorted(ordered), sorted(shuffled));
}

TEST(UniformScan, FurnitureHidesWhatIsUnderAndBehindIt) {
  json more = sampling(40000);
  more["furniture"] =
      json::parse(R"([{"room": "a", "at": [2, 2.7], "width": 1, "depth": 0.58, "height": 2}])");
  const auto xyz = test::all_points(test::box_scene(more));
  int on_box = 0;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Vec3 p = at(xyz, i);
    const bool beside = p.x() < 1.5 - 1e-5 || p.x() > 2.5 + 1e-5 || p.y() < 2.41 - 1e-5 || p.z() > 2 + 1e-5;
    if (beside) continue;
    ++on_box;  // on the box's front, sides or top, not on floor or wall behind
    EXPECT_GT(p.z(), 1e-6);
    EXPECT_LT(p.y(), 3 - 0.005);
  }
  EXPECT_GT(on_box, 1000);
}

TEST(UniformScan, WindowsHaveNoPointsInTheWallButOnTheirReveal) {
  json more = sampling(40000);
  more["windows"] =
      json::parse(R"([{"room": "a", "at": [2, 0], "width": 2, "height": 1, "sill": 1, "depth": 0.2}])");
  const auto xyz = test::all_points(test::box_scene(more));
  int reveal = 0;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Vec3 p = at(xyz, i);
    const bool before = std::abs(p.x() - 2) < 0.999 && std::abs(p.z() - 1.5) < 0.499;
    EXPECT_FALSE(before && p.y() < 0.01) << p.transpose();
    if (p.y() < -0.001) ++reveal;
  }
  EXPECT_GT(reveal, 100);
}

TEST(UniformScan, HolesTakeTheWantedShareOfTheSurface) {
  json more = sampling(1000);
  more["holes"] = 0.2;
  const Scene scene = test::box_scene(more);
  const Building building = place(scene);
  const TriangleMesh truth = make_truth(scene, building);
  const Surfaces surfaces(scene, building, truth);
  const Holes holes(scene, building, surfaces);
  const AreaTable areas(surfaces.triangles());
  int covered = 0;
  const int n = 40000;
  for (int i = 0; i < n; ++i) {
    const auto& triangle = surfaces.triangles()[areas.find((i + 0.5) / n * areas.total())];
    if (holes.covers(point_in(triangle, std::fmod(i * 0.7548776662, 1.0), std::fmod(i * 0.5698402910, 1.0))))
      ++covered;
  }
  EXPECT_NEAR(static_cast<double>(covered) / n, 0.2, 0.035);  // the largest patch is 2 of 59 m^2
  const auto xyz = test::all_points(scene);
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Vec3 p = at(xyz, i);
    EXPECT_FALSE(holes.covers(p * (1 + 1e-6)) && holes.covers(p * (1 - 1e-6))) << p.transpose();
  }
}

TEST(UniformScan, OutliersHaveTheirShareAndStayNearTheBuilding) {
  json more = sampling(50000);
  more["outliers"] = 0.1;
  const auto xyz = test::all_points(test::box_scene(more));
  int off = 0;
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Vec3 p = at(xyz, i);
    if (std::abs(test::box_distance(p, kLo, kHi)) > 1e-5) ++off;
    EXPECT_LT(test::box_distance(p, kLo - Vec3::Constant(0.5001), kHi + Vec3::Constant(0.5001)), 3);
  }
  EXPECT_NEAR(off, 5000, 300);
}

TEST(UniformScan, CopiesStandSideBySideAndShareThePoints) {
  json more = sampling(10001);
  more["repeat"] = json::parse(R"({"x": 2, "y": 1, "storeys": 2, "gap_m": 0.5})");
  const Scene scene = test::box_scene(more);
  const auto xyz = test::all_points(scene);
  ASSERT_EQ(xyz.size(), 30003U);
  std::array<int, 4> count{};
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Vec3 p = at(xyz, i);
    const int copy = (p.x() > 4.25 ? 1 : 0) + (p.z() > 2.75 ? 2 : 0);
    ++count[static_cast<std::size_t>(copy)];
    const Vec3 shift(copy % 2 == 1 ? 4.5 : 0, 0, copy >= 2 ? 3 : 0);
    ASSERT_LT(std::abs(test::box_distance(p - shift, kLo, kHi)), 1e-6);
  }
  for (const int c : count) EXPECT_NEAR(c, 2500, 1);
}

}  // namespace
}  // namespace roomcut::synthesize
