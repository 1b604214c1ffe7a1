// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/cell_pieces.h"

#include <gtest/gtest.h>

#include "tests/unit/cells/three_faces.h"

namespace roomcut {
namespace {

TEST(CellPieces, CellsThatShareAFaceAreOnePieceNumberedByItsFirstCell) {
  const CellComplex complex = three_faces();  // cells 0 1 2 below, 3 4 5 above
  const auto pieces = [&](const std::vector<bool>& member, bool through_levels) {
    return connected_pieces(
        complex, [&](std::size_t cell) { return member[cell]; },
        [&](const Interface& face) { return face.wall || through_levels; });
  };
  const CellPieces all = pieces({true, true, true, true, true, true}, true);
  EXPECT_EQ(all.count, 1);
  EXPECT_EQ(all.of_cell, (std::vector<std::int32_t>{0, 0, 0, 0, 0, 0}));
  const CellPieces layers = pieces({true, true, true, true, true, true}, false);
  EXPECT_EQ(layers.count, 2);
  EXPECT_EQ(layers.of_cell, (std::vector<std::int32_t>{0, 0, 0, 1, 1, 1}));
  const CellPieces apart = pieces({false, true, false, true, false, true}, true);
  EXPECT_EQ(apart.count, 2) << "3 and 5 share a side, 1 touches neither through a face";
  EXPECT_EQ(apart.of_cell, (std::vector<std::int32_t>{-1, 0, -1, 1, -1, 1}));
}

TEST(CellPieces, WithoutMembersThereIsNone) {
  const CellPieces none = connected_pieces(
      three_faces(), [](std::size_t) { return false; }, [](const Interface&) { return true; });
  EXPECT_EQ(none.count, 0);
  EXPECT_EQ(none.of_cell, std::vector<std::int32_t>(6, -1));
}

}  // namespace
}  // namespace roomcut
