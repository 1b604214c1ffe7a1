// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/cells/surfaces_io.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <limits>

#include "common/errors/codes.h"
#include "tests/unit/cells/three_faces.h"

namespace roomcut {
namespace {

class SurfacesIo : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("roomcut_surfaces_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    cells_.complex = three_faces();
    write_cells(folder_ / "cells.h5", cells_.complex, provenance_);
    cells_ = read_cells(folder_ / "cells.h5");
    surfaces_.surfaces = {{Vec2(0.25, -0.5), 2.5, 0.001, 12, 3456, -1}, {Vec2(0, 0), -1, 0.002, 4, 0, -1}};
    surfaces_.of_face = {-1, 0, 0, 1, -1, -1, -1, 1, 0};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string code_of(const LevelSurfaces& surfaces) {
    try {
      write_surfaces(folder_ / "surfaces.h5", surfaces, cells_, provenance_);
      read_surfaces(folder_ / "surfaces.h5", cells_);
    } catch (const StageError& error) {
      return error.problems()[0].code.id;
    }
    return "none";
  }

  std::string code_after(const std::function<void(LevelSurfaces&)>& spoil) {
    LevelSurfaces wrong = surfaces_;
    spoil(wrong);
    return code_of(wrong);
  }

  std::filesystem::path folder_;
  Provenance provenance_{"test", 1, "{}", "", {}};
  CellsFile cells_;
  LevelSurfaces surfaces_;
};

TEST_F(SurfacesIo, SurfacesComeBackAsTheyWere) {
  EXPECT_TRUE(write_surfaces(folder_ / "surfaces.h5", surfaces_, cells_, provenance_));
  EXPECT_FALSE(write_surfaces(folder_ / "surfaces.h5", surfaces_, cells_, provenance_));
  const LevelSurfaces read = read_surfaces(folder_ / "surfaces.h5", cells_);
  EXPECT_EQ(read.of_face, surfaces_.of_face);
  ASSERT_EQ(read.surfaces.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.surfaces[i].gradient, surfaces_.surfaces[i].gradient);
    EXPECT_EQ(read.surfaces[i].c, surfaces_.surfaces[i].c);
    EXPECT_EQ(read.surfaces[i].sigma_m, surfaces_.surfaces[i].sigma_m);
    EXPECT_EQ(read.surfaces[i].area_m2, surfaces_.surfaces[i].area_m2);
    EXPECT_EQ(read.surfaces[i].points, surfaces_.surfaces[i].points);
    EXPECT_EQ(read.surfaces[i].plane, surfaces_.surfaces[i].plane);
  }
}

TEST_F(SurfacesIo, AFileWithoutAnySurfaceIsTaken) {
  LevelSurfaces none;
  none.of_face.assign(9, -1);
  EXPECT_EQ(code_of(none), "none");
}

TEST_F(SurfacesIo, WhatPointsNowhereOrIsNoHeightIsDamage) {
  EXPECT_EQ(code_after([](LevelSurfaces&) {}), "none");
  EXPECT_EQ(code_after([](LevelSurfaces& s) { s.of_face[2] = 2; }), "A02");
  EXPECT_EQ(code_after([](LevelSurfaces& s) { s.of_face[2] = -2; }), "A02");
  EXPECT_EQ(code_after([](LevelSurfaces& s) { s.surfaces[0].plane = 0; }), "A02");
  EXPECT_EQ(code_after([](LevelSurfaces& s) { s.surfaces[0].points = -1; }), "A02");
  EXPECT_EQ(code_after([](LevelSurfaces& s) { s.surfaces[1].sigma_m = -1; }), "A02");
  EXPECT_EQ(code_after([](LevelSurfaces& s) { s.surfaces[1].area_m2 = 1e300; }), "A02");
  EXPECT_EQ(code_after([](LevelSurfaces& s) { s.surfaces[1].gradient.y() = 1e3; }), "A02");
  EXPECT_EQ(code_after([](LevelSurfaces& s) { s.surfaces[1].c = std::numeric_limits<double>::quiet_NaN(); }),
            "A02");
}

TEST_F(SurfacesIo, AWrongSizeIsABugAndOtherCellsAreRefused) {
  LevelSurfaces shorter = surfaces_;
  shorter.of_face.pop_back();
  EXPECT_THROW(write_surfaces(folder_ / "surfaces.h5", shorter, cells_, provenance_), std::logic_error);
  write_surfaces(folder_ / "surfaces.h5", surfaces_, cells_, provenance_);
  CellsFile other = cells_;
  other.payload_sha256 = "another";
  try {
    read_surfaces(folder_ / "surfaces.h5", other);
    ADD_FAILURE() << "taken";
  } catch (const StageError& error) {
    EXPECT_EQ(error.problems()[0].code.id, errors::kArtefactMismatch.id);
  }
}

}  // namespace
}  // namespace roomcut
