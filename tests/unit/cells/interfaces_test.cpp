// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/interfaces.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/cells/three_faces.h"

namespace roomcut {
namespace {

TEST(Interfaces, EveryFaceComesOnceWithItsTwoCellsAndItsArea) {
  const CellComplex complex = three_faces();
  std::set<std::pair<bool, std::size_t>> seen;
  double walls = 0;
  double levels = 0;
  for_each_interface(complex, [&](const Interface& face) {
    EXPECT_TRUE(seen.emplace(face.wall, face.index).second);
    (face.wall ? walls : levels) += face.area;
  });
  EXPECT_EQ(seen.size(), 10U * 2 + 3U * 3);
  EXPECT_NEAR(walls, (12 + 2 + 3) * 3.0, 1e-12);
  EXPECT_NEAR(levels, 8 * 3.0, 1e-12);
}

TEST(Interfaces, TheFacesOfACellAreThoseThatNameIt) {
  const CellComplex complex = three_faces();
  for (std::size_t cell = 0; cell < complex.cells(); ++cell) {
    std::set<std::tuple<bool, std::size_t, std::int64_t>> of_cell;
    for_each_interface_of(complex, cell, [&](const Interface& face, std::int64_t other) {
      of_cell.emplace(face.wall, face.index, other);
    });
    std::set<std::tuple<bool, std::size_t, std::int64_t>> expected;
    for_each_interface(complex, [&](const Interface& face) {
      const auto self = static_cast<std::int64_t>(cell);
      if (face.a == self || face.b == self) {
        expected.emplace(face.wall, face.index, face.a == self ? face.b : face.a);
      }
    });
    EXPECT_EQ(of_cell, expected);
  }
}

TEST(Interfaces, TheSurfaceOfOneCellIsItsBoundary) {
  const CellComplex complex = three_faces();
  std::vector<std::uint8_t> label(complex.cells(), 0);
  label[complex.cell(1, 0)] = 1;
  double area = 0;
  for (const Interface& face : surface_of(complex, label)) {
    area += face.area;
  }
  EXPECT_NEAR(area, 2 * 3 + 8 * 2.5, 1e-12);
}

TEST(Interfaces, UnknownIsNoSideOfTheModelButApartFromEmptyAndSolid) {
  const std::vector<std::uint8_t> label = {Label::kUnknown, Label::kEmpty, Label::kSolid};
  EXPECT_EQ(labels_of_model(label), (std::vector<std::uint8_t>{Label::kSolid, Label::kEmpty, Label::kSolid}));
  const auto between = [](std::int64_t a, std::int64_t b) { return Interface{true, 0, a, b, 1}; };
  EXPECT_TRUE(is_surface(between(0, 1), label));
  EXPECT_FALSE(is_surface(between(0, 2), label));
  EXPECT_TRUE(separates(between(0, 1), label));
  EXPECT_TRUE(separates(between(0, 2), label));
  EXPECT_TRUE(separates(between(0, Interface::kOutsideCell), label));
  EXPECT_FALSE(separates(between(2, Interface::kOutsideCell), label));
}

}  // namespace
}  // namespace roomcut
