// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/moments.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "stages/ingest/plane.h"

namespace roomcut::ingest {
namespace {

Eigen::Matrix3d matrix_of(const Spread& spread) {
  const auto& c = spread.covariance;
  Eigen::Matrix3d matrix;
  matrix << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
  return matrix;
}

TEST(Moments, give_the_covariance_exactly_even_when_the_sums_wrap) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::uint32_t> offset(0, 1500);
  for (const std::uint32_t corner : {0U, 150'000U, 0xff000000U}) {
    Moments moments;
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    constexpr std::uint64_t kPoints = 5000;
    for (std::uint64_t i = 0; i < kPoints; ++i) {
      const std::array<std::uint32_t, 3> p{offset(random), offset(random), offset(random)};
      moments.add_point(corner + p[0], corner + p[1], corner + p[2]);
      const Eigen::Vector3d v(p[0] - 700.0, p[1] - 700.0, p[2] - 700.0);
      sum += v;
      products += v * v.transpose();
    }
    const std::uint32_t centre = corner + 700;
    const Spread spread = spread_of(moments, {centre, centre, centre});
    const Eigen::Vector3d mean = sum / kPoints;
    EXPECT_NEAR(spread.mean[1], mean[1], 1e-9);
    EXPECT_LT((matrix_of(spread) - (products / kPoints - mean * mean.transpose())).norm(), 1e-6) << corner;
  }
}

TEST(Plane, agrees_with_an_eigen_solver_on_random_clouds) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    Eigen::Matrix3d a;
    for (int k = 0; k < 9; ++k) {
      a(k / 3, k % 3) = normal(random);
    }
    const double flat = std::pow(10.0, -4.0 * (i % 100) / 100);
    a.row(0) *= flat;
    const Eigen::Matrix3d turn =
        Eigen::HouseholderQR<Eigen::Matrix3d>(Eigen::Matrix3d::Random()).householderQ();
    const Eigen::Matrix3d covariance = 400 * turn * a * a.transpose() * turn.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    const Eigen::Vector3d& lambda = solver.eigenvalues();
    if (lambda[0] > 0.5 * lambda[1]) {
      continue;  // no plane: nobody looks at the normal
    }
    Spread spread;
    spread.covariance = {covariance(0, 0), covariance(0, 1), covariance(0, 2),
                         covariance(1, 1), covariance(1, 2), covariance(2, 2)};
    const Plane plane = plane_of(spread);
    EXPECT_NEAR(plane.lambda0, lambda[0], 2e-3 * lambda[1]) << i;
    EXPECT_NEAR(plane.lambda1, lambda[1], 5e-3 * lambda[1]) << i;
    const Eigen::Vector3d n(plane.normal[0], plane.normal[1], plane.normal[2]);
    EXPECT_GT(std::abs(n.dot(solver.eigenvectors().col(0))), 0.999) << i;
  }
}

TEST(Plane, of_an_exact_plane_has_no_thickness) {
  Moments moments;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const std::uint32_t x = i % 10;
    const std::uint32_t y = i / 10;
    moments.add_point(1000 + x, 1000 + y, 1000 + 2 * x + 3 * y);
  }
  const Plane plane = plane_of(spread_of(moments, {1000, 1000, 1000}));
  EXPECT_NEAR(plane.lambda0, 0, 1e-9);
  const double length = std::sqrt(14.0);
  EXPECT_NEAR(std::abs(plane.normal[0]), 2 / length, 1e-9);
  EXPECT_NEAR(std::abs(plane.normal[1]), 3 / length, 1e-9);
  EXPECT_NEAR(std::abs(plane.normal[2]), 1 / length, 1e-9);
}

TEST(Plane, of_a_line_or_a_place_has_no_second_direction) {
  Moments line;
  Moments place;
  for (std::uint32_t i = 0; i < 50; ++i) {
    line.add_point(100 + i, 200 + 2 * i, 300);
    place.add_point(100, 200, 300);
  }
  EXPECT_NEAR(plane_of(spread_of(line, {100, 200, 300})).lambda1, 0, 1e-6);
  EXPECT_EQ(plane_of(spread_of(place, {100, 200, 300})).lambda1, 0);
}

}  // namespace
}  // namespace roomcut::ingest
