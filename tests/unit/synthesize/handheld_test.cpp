// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/handheld.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

#include "tests/unit/synthesize/test_scenes.h"

namespace roomcut::synthesize {
namespace {

TEST(SmoothField, HasItsDeviationAndVariesOverItsCorrelation) {
  const SmoothField field(0.02, 1, 7, 1);
  double square = 0, near = 0, far = 0;
  constexpr int kPlaces = 4000;
  for (int i = 0; i < kPlaces; ++i) {
    const Vec3 p(0.37 * i, 0.91 * (i % 61), 0.53 * (i % 17));
    const Vec3 here = field.at(p);
    square += here.squaredNorm() / (3.0 * kPlaces);
    near += here.dot(field.at(p + Vec3(0.1, 0, 0))) / (3.0 * kPlaces);
    far += here.dot(field.at(p + Vec3(0, 3, 0))) / (3.0 * kPlaces);
  }
  EXPECT_NEAR(std::sqrt(square), 0.02, 0.005);
  EXPECT_GT(near, 0.98 * square);
  EXPECT_LT(std::abs(far), 0.3 * square);
}

struct Scan {
  Scene scene;
  Building building;
  TriangleMesh truth;
  Surfaces surfaces;
  Handheld handheld;
  explicit Scan(const nlohmann::json& errors)
      : scene(test::box_scene({{"handheld", errors}})),
        building(place(scene)),
        truth(make_truth(scene, building)),
        surfaces(scene, building, truth),
        handheld(scene, surfaces) {}
};

TEST(Handheld, RoundsTheCornersOfARoomAndNothingElse) {
  const Scan scan(nlohmann::json{{"rounding_m", 0.05}});
  bool floor = false;
  for (const SurfaceTriangle& triangle : scan.surfaces.triangles()) {
    const Vec3 normal = triangle.u.cross(triangle.v).normalized();
    if (normal.z() > -0.9) continue;
    floor = true;
    const Vec3 middle(2, 1.5, 0), edge(2, 0, 0), beside(2, 0.02, 0), corner(0, 0, 0);
    EXPECT_NEAR((scan.handheld.measured(middle, triangle) - middle).norm(), 0, 1e-12);
    // The ball's middle is 5 cm from floor and wall: its surface is (sqrt 2 - 1) * 5 cm off the edge.
    EXPECT_NEAR((scan.handheld.measured(edge, triangle) - edge).norm(), 0.05 * (std::sqrt(2) - 1), 1e-6);
    const Vec3 round = scan.handheld.measured(beside, triangle);
    EXPECT_NEAR((round - Vec3(2, 0.05, 0.05)).norm(), 0.05, 1e-6);
    EXPECT_NEAR((scan.handheld.measured(corner, triangle) - corner).norm(), 0.05 * (std::sqrt(3) - 1), 1e-6);
  }
  EXPECT_TRUE(floor);
}

TEST(Handheld, WithoutItsErrorsEveryPlaceIsMeasuredWhereItIs) {
  const Scan scan(nlohmann::json::object());
  const Vec3 p(2, 0, 0);
  EXPECT_EQ(scan.handheld.measured(p, scan.surfaces.triangles().front()), p);
}

TEST(Handheld, WarpsAndDriftsWholeSurfaces) {
  const Scan scan(nlohmann::json{{"warp_m", 0.02}, {"drift_m", 0.1}});
  const SurfaceTriangle& triangle = scan.surfaces.triangles().front();
  const auto shift = [&](const Vec3& p) { return (scan.handheld.measured(p, triangle) - p).eval(); };
  EXPECT_GT(shift({1, 1, 0}).norm(), 0.01);
  EXPECT_LT((shift({1, 1, 0}) - shift({1.02, 1, 0})).norm(), 0.01) << "smoothly";
}

}  // namespace
}  // namespace roomcut::synthesize
