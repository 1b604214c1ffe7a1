// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/comparable.h"

#include <gtest/gtest.h>

#include "common/errors/codes.h"

namespace roomcut::evaluate {
namespace {

const Bounds3 kModel{{0, 0, 0}, {10, 8, 2.7}};

Bounds3 scaled(const Bounds3& box, double factor) {
  return {factor * box.lo, factor * box.hi};
}

/// Text of the error, "" when there is none.
std::string refusal(const Bounds3& model, const Bounds3& truth) {
  try {
    require_comparable({"model.ply", model}, {"truth.off", truth});
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems()[0].code.id, errors::kMeshesUnlike.id);
    return to_string(error.problems()[0]);
  }
  return "";
}

TEST(Comparable, MeshesOfOneBuildingAre) {
  EXPECT_EQ(refusal(kModel, kModel), "");
  EXPECT_EQ(refusal(kModel, {{-0.3, -0.3, -0.2}, {10.4, 8.3, 3.1}}), "");
  EXPECT_EQ(refusal({{2, 3, 0}, {5, 5, 2.5}}, {{0, 0, 0}, {120, 60, 12}}), "") << "one room of many";
  EXPECT_EQ(refusal(kModel, {{0, 0, 0}, {32.8, 26.2, 2.7}}), "") << "a part of one storey";
}

TEST(Comparable, AnotherUnitIsNamedAndWhoIsInIt) {
  for (const auto& [factor, name] : {std::pair(1000.0, "millimetres"), std::pair(100.0, "centimetres"),
                                     std::pair(39.37, "inches"), std::pair(3.28084, "feet")}) {
    for (const double error : {0.95, 1.0, 1.05}) {
      const std::string truth = refusal(kModel, scaled(kModel, factor * error));
      EXPECT_NE(truth.find(std::string("truth.off is probably in ") + name), std::string::npos) << truth;
      const std::string model = refusal(scaled(kModel, factor * error), kModel);
      EXPECT_NE(model.find(std::string("model.ply is probably in ") + name), std::string::npos) << model;
    }
  }
}

TEST(Comparable, AnotherSizeOrPlaceIsRefused) {
  EXPECT_NE(refusal(kModel, {{0, 0, 0}, {4000, 8, 2.7}}).find("times as large"), std::string::npos);
  EXPECT_NE(refusal({{11, 0, 0}, {20, 8, 2.7}}, kModel).find("do not meet"), std::string::npos);
  EXPECT_NE(refusal(kModel, {{0, 0, 3}, {10, 8, 5}}).find("do not meet"), std::string::npos);
}

}  // namespace
}  // namespace roomcut::evaluate
