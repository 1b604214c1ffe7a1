// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/compare_lines.h"

#include "tests/unit/wall_lines/lines_fixture.h"

namespace roomcut {
namespace {

using testing::make_line;

const std::vector<WallLine> kBase{make_line("w0001", {0, 0}, {4, 0}), make_line("w0002", {0, 3}, {4, 3}),
                                  make_line("w0003", {0, 0}, {0, 3})};

TEST(CompareLines, AReversedLineIsTheSame) {
  EXPECT_TRUE(same_geometry(make_line("a", {0, 0}, {4, 0}), make_line("b", {4, 0}, {0, 0})));
}

TEST(CompareLines, RoundingToSixDecimalsIsNoMoveAndTenMicrometresAre) {
  EXPECT_TRUE(same_geometry(kBase[0], make_line("b", {1e-6, 0}, {4, -1e-6})));
  EXPECT_FALSE(same_geometry(kBase[0], make_line("b", {1e-5, 0}, {4, 0})));
}

TEST(CompareLines, SaysHowFarALineMovedAtItsCentre) {
  const LineDifferences found =
      compare_lines(kBase, {make_line("w0001", {0, 0.1}, {4, 0.1}), kBase[1], kBase[2]});
  ASSERT_EQ(found.moved.size(), 1U);
  EXPECT_NEAR(found.moved[0].offset_m, 0.1, 1e-12);
  EXPECT_NEAR(found.moved[0].angle_rad, 0, 1e-12);
  EXPECT_EQ(found.same.size(), 2U);
}

TEST(CompareLines, FindsAddedAndDeletedLines) {
  const LineDifferences found = compare_lines(kBase, {kBase[0], make_line("x", {1, 1}, {2, 1})});
  EXPECT_EQ(found.added, std::vector<std::string>{"x"});
  EXPECT_EQ(found.deleted, (std::vector<std::string>{"w0002", "w0003"}));
}

TEST(CompareLines, ALineThatOnlyGotAnotherIdIsTheSame) {
  const LineDifferences found = compare_lines(kBase, {make_line("x", {4, 0}, {0, 0}), kBase[1], kBase[2]});
  EXPECT_EQ(found.same.size(), 3U);
  EXPECT_TRUE(found.added.empty());
  EXPECT_TRUE(found.deleted.empty());
}

TEST(CompareLines, APieceOfAPolylineComesFromItsParent) {
  EXPECT_EQ(base_id("w0002.1", kBase), "w0002");
  EXPECT_EQ(base_id("w0002", kBase), "w0002");
  EXPECT_EQ(base_id("w0002.x", kBase), "");
  EXPECT_EQ(base_id("w0009.1", kBase), "");
}

}  // namespace
}  // namespace roomcut
