// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/curved_walls.h"

#include <gtest/gtest.h>

#include "common/wall_lines/wall_arc.h"
#include "tests/unit/extract/grid_complex.h"

namespace roomcut::extract {
namespace {

/// Three cells in a row, the middle one empty; the line between the first two is a chord of an arc.
struct Row {
  CellComplex complex = testing_row();
  WallLines lines;
  std::vector<std::uint8_t> label{Label::kSolid, Label::kEmpty, Label::kSolid};
  std::vector<std::int16_t> storey{0, 2, 0};

  static CellComplex testing_row() { return test::grid_complex({0, 1, 2, 3}, {0, 1}, {0, 2.5}); }

  explicit Row(double from_y = 0) {
    for (const CellComplex::Line& line : complex.lines) {
      const Vec2 middle = line.line.at(0.5 * (line.t0 + line.t1));
      if (std::abs(middle.x() - 1) > 1e-9 || std::abs(line.line.normal().x()) < 0.5) continue;
      WallLine chord;
      chord.id = line.wall_id;
      chord.a = {1, from_y};
      chord.b = {1, from_y + 1};
      set_arc(chord, WallArc{"a0001", {-2, 0.5}, 3.02}, lines.frame);
      lines.lines.push_back(chord);
    }
  }
  std::vector<CurvedWall> walls() const { return find_curved_walls(lines, complex, label, storey); }
};

TEST(CurvedWalls, AnArcOfWhichTheModelHasAFaceIsListed) {
  const Row row;
  ASSERT_EQ(row.lines.lines.size(), 1U);
  const std::vector<CurvedWall> walls = row.walls();
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_EQ(walls[0].id, "a0001");
  EXPECT_NEAR(walls[0].area_m2, 2.5, 1e-9);
  EXPECT_EQ(walls[0].storeys, std::vector<int>{2});
  EXPECT_EQ(walls[0].wall_ids.size(), 1U);
  EXPECT_NEAR(walls[0].to - walls[0].from, 2 * std::atan(0.5 / 3), 1e-9);
  EXPECT_NEAR(walls[0].from, -std::atan(0.5 / 3), 1e-9);
  EXPECT_NEAR(walls[0].z1 - walls[0].z0, 2.5, 1e-12);
}

TEST(CurvedWalls, WithoutAFaceOrBeyondItsChordThereIsNone) {
  Row same;
  same.label = {Label::kEmpty, Label::kEmpty, Label::kSolid};
  EXPECT_TRUE(same.walls().empty());
  EXPECT_TRUE(Row(5).walls().empty());  // the line goes on, the arc does not
}

}  // namespace
}  // namespace roomcut::extract
