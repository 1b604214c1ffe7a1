// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "common/cells/interfaces.h"
#include "common/random/counter_random.h"
#include "tests/accuracy/learn/teacher.h"
#include "tests/unit/graphcut/random_cells.h"

namespace roomcut::learn {
using namespace roomcut::testing;

namespace {

constexpr int kOpen = 1, kRoom = 2;  // weights: constant, "open", "room"

/// Cells of 1 m that are rooms with the log-odds of `right`; raycast had weighed them with `recorded`.
LessonData grid_lesson(const std::string& building, std::uint64_t seed, const Eigen::Vector3d& right,
                       const Eigen::Vector3d& recorded) {
  LessonData data;
  data.scene = building + std::to_string(seed);
  data.building = building;
  data.complex = grid_complex(6, 6, 3);
  data.weights = no_weights(data.complex);
  data.params.mu_m = 0.02;
  data.params.unknown = "decided";
  const std::size_t count = data.complex.cells();
  std::vector<float> open(count), room(count), beta(count);
  for (std::size_t c = 0; c < count; ++c) {
    open[c] = static_cast<float>(random_unit(seed, 1, c));
    room[c] = static_cast<float>(random_unit(seed, 2, c));
    const auto odds = [&](const Eigen::Vector3d& w) {
      return w[0] + w[kOpen] * open[c] + w[kRoom] * room[c];
    };
    beta[c] = static_cast<float>(1 / (1 + std::exp(-odds(recorded))));
    data.sampled.push_back(data.complex.volume(c));
    data.empty.push_back(odds(right) > 0 ? data.sampled[c] : 0);
  }
  data.terms = terms_of(data.complex, beta);
  data.terms.constant = recorded[0];
  data.terms.features = {{"open", recorded[kOpen], "", open}, {"room", recorded[kRoom], "", room}};
  return data;
}

const Eigen::Vector3d kRight(0, -4, 4), kPrior(-1, 0, 3), kOdd(0, 6, -6);

std::vector<Lesson> two_buildings(const Eigen::Vector3d& of_the_second = kRight) {
  std::vector<Lesson> lessons;
  for (const std::uint64_t seed : {1, 2}) {
    lessons.emplace_back(grid_lesson("first", seed, kRight, kPrior));
    lessons.emplace_back(grid_lesson("second", 10 + seed, of_the_second, kPrior));
  }
  return lessons;
}

Evolved learned(std::vector<Lesson>& lessons, const std::string& left_out = "", std::size_t threads = 2) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  EvolutionParams params;
  params.generations = 60;
  return learned_weights({lessons, kPrior, kPrior}, left_out, params);
}

TEST(Evolution, FindsTheBottomOfANarrowValleyWhereverItStarts) {
  const auto costs = [](const std::vector<Eigen::VectorXd>& candidates) {
    std::vector<double> cost;
    cost.reserve(candidates.size());
    for (const Eigen::VectorXd& v : candidates) {
      cost.push_back(std::pow(v[0] - 1, 2) + 1000 * std::pow(v[1] + v[0], 2) + std::pow(v[2] - 3, 2));
    }
    return cost;
  };
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Evolved found =
        evolve(costs, Eigen::Vector3d(-2, 5, 0), Eigen::Vector3d(1, 2, 1), {0.3, 100, 12, seed});
    EXPECT_LT((found.best - Eigen::Vector3d(1, -1, 3)).norm(), 1e-3);
  }
}

TEST(Learn, AWeightThatThePriorHasWrongIsLearned) {
  std::vector<Lesson> lessons = two_buildings();
  const Evolved found = learned(lessons);
  EXPECT_LT(found.best[kOpen], -1);
  for (Lesson& lesson : lessons) {
    EXPECT_GT(lesson.loss(kPrior), 0.3);
    EXPECT_LT(lesson.loss(found.best), 0.5 * lesson.loss(kPrior));
    EXPECT_GT(lesson.iou(found.best), lesson.iou(kPrior) + 0.05);
    EXPECT_EQ(lesson.bound(), 1);
  }
}

TEST(Learn, WhatPhysicsSaysSpeaksForEmptyNeverSpeaksAgainstIt) {
  std::vector<Lesson> lessons = two_buildings();
  const Eigen::Vector3d against(-1, 1, 3);
  const Evolved found = learned_weights({lessons, kPrior, against}, "", {0.3, 60, 12, 1});
  EXPECT_GE(found.best[kOpen], 0);
  EXPECT_GT(found.best[kRoom], 0);
}

TEST(Learn, WhatIsLearnedDependsOnNoThreads) {
  std::vector<Lesson> lessons = two_buildings();
  const Evolved one = learned(lessons, "", 1), two = learned(lessons, "", 2);
  EXPECT_EQ(one.best, two.best);
  EXPECT_EQ(one.cost, two.cost);
}

TEST(Learn, ABuildingThatIsLeftOutHasNoSay) {
  std::vector<Lesson> alike = two_buildings(), odd = two_buildings(kOdd);
  EXPECT_EQ(learned(alike, "second").best, learned(odd, "second").best);
  EXPECT_NE(learned(alike).best, learned(odd).best);
  EXPECT_GT(learned(odd, "first").best[kOpen], 2);
}

TEST(Learn, AWeightOfWhichNoLessonTellsKeepsItsPrior) {
  std::vector<Lesson> lessons;
  for (const std::uint64_t seed : {1, 2}) {
    LessonData data = grid_lesson("building", seed, kRight, kPrior);
    data.terms.features.push_back({"looked_through", 3, "", std::vector<float>(data.sampled.size(), 0.0F)});
    lessons.emplace_back(std::move(data));
  }
  const Eigen::Vector4d prior(kPrior[0], kPrior[1], kPrior[2], 3);
  const Evolved found = learned_weights({lessons, prior, prior}, "", {0.3, 60, 12, 1});
  EXPECT_EQ(found.best[3], 3);
  EXPECT_LT(found.best[kOpen], -1);
}

TEST(Learn, NothingToLearnFromIsAnError) {
  std::vector<Lesson> lessons;
  lessons.emplace_back(grid_lesson("only", 1, kRight, kPrior));
  EXPECT_THROW(learned(lessons, "only"), std::invalid_argument);
}

TEST(Learn, AMadeUpSceneMustNotBecomeWorseThanWithTheShippedWeights) {
  const Eigen::Vector3d shipped(0, -16, 16);  // so steep that a little off the constant changes little
  const auto loss_of_second = [&](bool made_up) {
    std::vector<Lesson> lessons;
    lessons.emplace_back(grid_lesson("real", 1, Eigen::Vector3d(-2, -16, 16), shipped));
    LessonData other = grid_lesson("house", 2, shipped, shipped);
    other.made_up = made_up;
    lessons.emplace_back(std::move(other));
    const School school{lessons, shipped, shipped};
    return lessons[1].loss(learned_weights(school, made_up ? "" : "house", {0.3, 60, 12, 1}).best);
  };
  EXPECT_LT(loss_of_second(true), 0.1);
  EXPECT_GT(loss_of_second(false), 0.2);
}

TEST(Lesson, LossAndIouCountWhatTheTruthSaysAndNothingWithoutTruth) {
  LessonData data = grid_lesson("a", 1, kRight, kPrior);
  const Eigen::VectorXd all_solid = Eigen::Vector3d(-20, 0, 0);
  EXPECT_NEAR(Lesson(data).loss(all_solid), 1, 1e-12) << "every room is lost";
  double truth = 0, ignored = 0;
  for (std::size_t c = 0; c < data.sampled.size(); ++c) {
    truth += data.empty[c];
    if (data.empty[c] == 0 && ignored == 0) {
      ignored = data.sampled[c];
      data.sampled[c] = 0;
    }
  }
  ASSERT_GT(ignored, 0);
  const Eigen::VectorXd all_empty = Eigen::Vector3d(20, 0, 0);
  double solid = -truth - ignored;
  for (std::size_t c = 0; c < data.sampled.size(); ++c) {
    solid += data.complex.volume(c);
  }
  EXPECT_NEAR(Lesson(data).loss(all_empty), solid / truth, 1e-9);
  EXPECT_NEAR(Lesson(data).iou(all_empty), truth / (truth + solid), 1e-9);
}

TEST(Lesson, ALostWallBetweenRoomsCostsMoreThanItsVolume) {
  LessonData data = grid_lesson("a", 1, Eigen::Vector3d(20, 0, 0), kPrior);
  std::size_t wall = 0;
  for (std::size_t c = 0; c < data.sampled.size(); ++c) {
    const Vec3 at = data.complex.centre(c);
    if (std::abs(at.x() - 3.5) < 0.1 && std::abs(at.y() - 3.5) < 0.1 && std::abs(at.z() - 1.5) < 0.1) {
      wall = c;
    }
  }
  data.empty[wall] = 0;
  const Eigen::VectorXd all_empty = Eigen::Vector3d(20, 0, 0);
  const double as_wide_block = Lesson(data).loss(all_empty);
  data.terms.thin[wall] = 1;
  const double as_wall = Lesson(data).loss(all_empty);
  EXPECT_GT(as_wide_block, 0);
  EXPECT_NEAR(as_wall, 4 * as_wide_block, 1e-12);
}

TEST(Lesson, FeaturesThatDoNotGiveBetaAreRefused) {
  LessonData data = grid_lesson("a", 1, kRight, kPrior);
  data.terms.beta[0] = 1 - data.terms.beta[0];
  EXPECT_THROW(Lesson{data}, std::invalid_argument);
}

}  // namespace
}  // namespace roomcut::learn
