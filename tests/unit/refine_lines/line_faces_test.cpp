// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/line_faces.h"

#include <gtest/gtest.h>

#include "tests/unit/refine_lines/grid_building.h"

namespace roomcut::refine_lines {
namespace {

using testing::grid_complex;
using testing::labelled;

const LineFaces& of(const std::vector<LineFaces>& all, const CellComplex& complex, const std::string& id) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (complex.lines[i].wall_id == id) {
      return all[i];
    }
  }
  throw std::runtime_error("no line " + id);
}

TEST(LineFaces, ARoomsWallsCarrySurfaceOverItsLengthAndLookInward) {
  const CellComplex complex = grid_complex({-2, 0, 5, 7}, {-2, 0, 4, 6}, {0, 2.5, 3});
  ASSERT_EQ(find_violation(complex), "");
  const auto label = labelled(complex, [](const Vec2& p, std::size_t layer) {
    return layer == 0 && p.x() > 0 && p.x() < 5 && p.y() > 0 && p.y() < 4;
  });
  const auto all = find_line_faces(complex, label, 0.1);
  const LineFaces& west = of(all, complex, "x1");
  EXPECT_NEAR(west.area_m2, 10, 1e-9);
  EXPECT_NEAR(west.t1 - west.t0, 4, 1e-9);
  EXPECT_EQ(west.bins, 40U);
  for (std::size_t bin = 0; bin < west.bins; ++bin) {
    EXPECT_EQ(west.side_at(bin, 0), 1);  // theta 0: the normal points to +x, into the room
    EXPECT_EQ(west.side_at(bin, 1), 0);
  }
  EXPECT_EQ(of(all, complex, "x2").side_at(7, 0), -1);
  EXPECT_EQ(of(all, complex, "y1").side_at(7, 0), 1);
  EXPECT_EQ(of(all, complex, "y2").side_at(7, 0), -1);
  EXPECT_NEAR(of(all, complex, "y1").area_m2, 12.5, 1e-9);
}

TEST(LineFaces, WallsOfUnknownSpacesStayForTheSecondCut) {
  const CellComplex complex = grid_complex({-2, 0, 5, 9, 11}, {-2, 0, 4, 6}, {0, 2.5});
  auto label = labelled(
      complex, [](const Vec2& p, std::size_t) { return p.x() > 0 && p.x() < 5 && p.y() > 0 && p.y() < 4; });
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    const Vec2 at = complex.centroid(f);
    if (at.x() > 5 && at.x() < 9 && at.y() > 0 && at.y() < 4) {
      label[complex.cell(f, 0)] = Label::kUnknown;
    }
  }
  const auto all = find_line_faces(complex, label, 0.1);
  EXPECT_EQ(of(all, complex, "x2").side_at(7, 0), -1) << "the room is the emptier side";
  EXPECT_EQ(of(all, complex, "x3").side_at(7, 0), -1) << "the unknown space is";
  EXPECT_NEAR(of(all, complex, "x3").area_m2, 10, 1e-9);
}

TEST(LineFaces, FacesThatMeetInsideABinLeaveNoGap) {
  // y 1.23 cuts the west wall in two edges of one line.
  const CellComplex complex = grid_complex({-2, 0, 5, 7}, {-2, 0, 1.23, 4, 6}, {0, 2.5});
  const auto label = labelled(
      complex, [](const Vec2& p, std::size_t) { return p.x() > 0 && p.x() < 5 && p.y() > 0 && p.y() < 4; });
  const auto all = find_line_faces(complex, label, 0.1);
  const LineFaces& west = of(all, complex, "x1");
  for (std::size_t bin = 0; bin < west.bins; ++bin) {
    EXPECT_EQ(west.side_at(bin, 0), 1) << bin;
  }
  EXPECT_EQ(of(all, complex, "y2").bins, 0U);
}

TEST(LineFaces, AShortWallStillGivesTenBins) {
  const CellComplex complex = grid_complex({-2, 0, 0.4, 2}, {-2, 0, 4, 6}, {0, 2.5});
  const auto label = labelled(
      complex, [](const Vec2& p, std::size_t) { return p.x() > 0 && p.x() < 0.4 && p.y() > 0 && p.y() < 4; });
  const auto all = find_line_faces(complex, label, 0.1);
  EXPECT_EQ(of(all, complex, "y1").bins, 10U);
  EXPECT_EQ(of(all, complex, "x1").bins, 40U);
}

}  // namespace
}  // namespace roomcut::refine_lines
