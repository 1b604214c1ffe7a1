// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/slices/slices_io.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <limits>

#include "common/artefact/h5.h"
#include "common/errors/error.h"

namespace roomcut {
namespace {

class SlicesIo : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("roomcut_slices_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path path() const { return folder_ / "slices.h5"; }

 private:
  std::filesystem::path folder_;
};

OccupancyGrid grid(int cells) {
  OccupancyGrid g;
  for (int i = 0; i < cells; ++i) {
    g.ix.push_back(i - 1);
    g.iy.push_back(-2);
    g.x.push_back(0.04F * static_cast<float>(i));
    g.y.push_back(-0.07F);
    g.coverage.push_back(0.5F);
    g.weight_m.push_back(0.02F);
    g.area_m2.push_back(0.01F);
    g.azimuth.push_back(static_cast<std::uint8_t>(200 + i));
    g.azimuth_trust.push_back(250);
  }
  return g;
}

Slices example() {
  Slices slices;
  slices.frame.origin[0] = 4.5e6;
  slices.bbox_min = {-1, -2, -0.1};
  slices.bbox_max = {3, 4, 2.6};
  slices.noise_m = 0.004;
  slices.density = 480;
  slices.tau_m = 0.04;
  slices.histogram = {-0.105, 0.005, {0, 1.5, 20, 0}};
  slices.levels = {{0, -0.02, 0.02, 20, 19, false},
                   {2.4, 2.38, 2.42, 8, 8, false, true},
                   {2.6, 2.6, 2.6, 0, 0, true, false}};
  slices.wall_slices = {grid(5), grid(0)};
  slices.planes = {{{0.3, -0.1}, 2.5, {{0, 0}, {3, 0}, {3, 2}, {0, 2}}, 6.2, 0.004, true},
                   {{0, 0.06}, -1, {{1, 1}, {2, 1}, {1, 3}}, 2.1, 0.005, false}};
  return slices;
}

/// Writes slices.h5 as version 1.1 had it.
void write_without_planes(const std::filesystem::path& path) {
  const Slices all = example();
  write_slices(path, all, {});
  H5Reader from(path, artefacts::kSlices);
  H5Writer to(path.string() + ".old", {"slices", 1, 1}, {}, all.frame);
  const auto copy = [&]<class T>(T, const char* name) {
    to.write(name, from.read<T>(name), "1", "as it was");
  };
  for (const char* name :
       {"bbox_min", "bbox_max", "noise", "density", "tau", "histogram/z0", "histogram/bin", "histogram/area",
        "levels/z", "levels/lo", "levels/hi", "levels/area", "levels/component"}) {
    copy(double{}, name);
  }
  for (const char* name : {"levels/cap", "levels/step", "wall_slices/azimuth", "wall_slices/azimuth_trust"}) {
    copy(std::uint8_t{}, name);
  }
  for (const char* name :
       {"wall_slices/x", "wall_slices/y", "wall_slices/coverage", "wall_slices/weight", "wall_slices/area"}) {
    copy(float{}, name);
  }
  for (const char* name : {"wall_slices/ix", "wall_slices/iy"}) copy(std::int32_t{}, name);
  copy(std::uint64_t{}, "wall_slices/offset");
  to.commit();
  std::filesystem::rename(path.string() + ".old", path);
}

TEST_F(SlicesIo, WhatIsWrittenIsRead) {
  const Slices out = example();
  EXPECT_TRUE(write_slices(path(), out, {}));
  const Slices in = read_slices(path());
  EXPECT_EQ(in.frame.origin[0], 4.5e6);
  EXPECT_EQ(in.bbox_max, out.bbox_max);
  EXPECT_EQ(in.tau_m, out.tau_m);
  EXPECT_EQ(in.noise_m, out.noise_m);
  EXPECT_EQ(in.density, out.density);
  EXPECT_EQ(in.histogram.area_m2, out.histogram.area_m2);
  EXPECT_EQ(in.histogram.z0, out.histogram.z0);
  ASSERT_EQ(in.levels.size(), 3U);
  EXPECT_EQ(in.levels[1].z, 2.4);
  EXPECT_EQ(in.levels[1].lo, 2.38);
  EXPECT_EQ(in.levels[1].hi, 2.42);
  EXPECT_EQ(in.levels[0].area_m2, 20);
  EXPECT_EQ(in.levels[0].component_m2, 19);
  EXPECT_TRUE(in.levels[2].cap);
  EXPECT_TRUE(in.levels[1].step);
  EXPECT_FALSE(in.levels[2].step);
  ASSERT_EQ(in.wall_slices.size(), 2U);
  EXPECT_EQ(in.wall_slices[0].ix, out.wall_slices[0].ix);
  EXPECT_EQ(in.wall_slices[0].iy, out.wall_slices[0].iy);
  EXPECT_EQ(in.wall_slices[0].x, out.wall_slices[0].x);
  EXPECT_EQ(in.wall_slices[0].weight_m, out.wall_slices[0].weight_m);
  EXPECT_EQ(in.wall_slices[0].area_m2, out.wall_slices[0].area_m2);
  EXPECT_EQ(in.wall_slices[0].azimuth, out.wall_slices[0].azimuth);
  EXPECT_EQ(in.wall_slices[0].azimuth_trust, out.wall_slices[0].azimuth_trust);
  EXPECT_EQ(in.wall_slices[1].size(), 0U);
  ASSERT_EQ(in.planes.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(in.planes[i].gradient, out.planes[i].gradient);
    EXPECT_EQ(in.planes[i].c, out.planes[i].c);
    EXPECT_EQ(in.planes[i].outline, out.planes[i].outline);
    EXPECT_EQ(in.planes[i].area_m2, out.planes[i].area_m2);
    EXPECT_EQ(in.planes[i].rms_m, out.planes[i].rms_m);
    EXPECT_EQ(in.planes[i].ceiling, out.planes[i].ceiling);
  }
}

TEST_F(SlicesIo, FilesBeforeVersion12HaveNoPlanes) {
  Slices out = example();
  out.planes.clear();
  write_slices(path(), out, {});
  EXPECT_TRUE(read_slices(path()).planes.empty());
  // A file of version 1.1 is one of 1.2 without the group.
  write_without_planes(path());
  const Slices in = read_slices(path());
  EXPECT_TRUE(in.planes.empty());
  EXPECT_EQ(in.levels.size(), 3U);
}

TEST_F(SlicesIo, WithoutGridsOnlyTheLevelsAreRead) {
  write_slices(path(), example(), {});
  const Slices in = read_slices(path(), false);
  EXPECT_EQ(in.levels.size(), 3U);
  ASSERT_EQ(in.wall_slices.size(), 2U);
  EXPECT_EQ(in.wall_slices[0].size(), 0U);
}

TEST_F(SlicesIo, EqualContentIsNoNewPayload) {
  EXPECT_TRUE(write_slices(path(), example(), {}));
  EXPECT_FALSE(write_slices(path(), example(), {}));
  Slices other = example();
  other.levels[1].z += 1e-6;
  EXPECT_TRUE(write_slices(path(), other, {}));
}

TEST_F(SlicesIo, LevelsOutOfOrderAreDamage) {
  Slices wrong = example();
  std::swap(wrong.levels[0], wrong.levels[1]);
  write_slices(path(), wrong, {});
  try {
    read_slices(path());
    FAIL() << "no error";
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems().front().code.id, "A02");
    EXPECT_NE(std::string(error.what()).find("levels/z"), std::string::npos);
  }
}

/// The text of the error that reading what `spoil` left gives; the digest fits, as of a file made by someone.
template <class Spoil>
std::string complaint(const std::filesystem::path& path, Spoil spoil) {
  Slices wrong = example();
  spoil(wrong);
  write_slices(path, wrong, {});
  try {
    read_slices(path);
  } catch (const StageError& error) {
    return error.what();
  }
  return "";
}

TEST_F(SlicesIo, CellsThatWouldIndexOutsideTheGridAreDamage) {
  EXPECT_EQ(complaint(path(), [](Slices&) {}), "");
  const auto expect_damage = [&](const std::string& dataset, auto spoil) {
    const std::string text = complaint(path(), spoil);
    EXPECT_NE(text.find("A02"), std::string::npos) << dataset << text;
    EXPECT_NE(text.find(dataset), std::string::npos) << text;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expect_damage("wall_slices/iy", [](Slices& s) { s.wall_slices[0].iy[2] = -2'000'000'000; });
  expect_damage("wall_slices/iy", [](Slices& s) { s.wall_slices[0].iy[4] = 2'000'000'000; });
  expect_damage("wall_slices/iy",
                [](Slices& s) { std::swap(s.wall_slices[0].ix[1], s.wall_slices[0].ix[2]); });
  expect_damage("wall_slices/iy", [](Slices& s) { s.wall_slices[0].ix[1] = s.wall_slices[0].ix[0]; });
  expect_damage("wall_slices/ix", [](Slices& s) { s.wall_slices[0].ix[4] = 200; });
  expect_damage("wall_slices/x", [nan](Slices& s) { s.wall_slices[0].x[1] = nan; });
  expect_damage("wall_slices/y", [](Slices& s) { s.wall_slices[0].y[1] = 3; });
  expect_damage("wall_slices/weight", [](Slices& s) { s.wall_slices[0].weight_m[1] = -1; });
  expect_damage("wall_slices/coverage", [nan](Slices& s) { s.wall_slices[0].coverage[0] = nan; });
}

TEST_F(SlicesIo, NumbersThatNoBuildingHasAreDamage) {
  const auto expect_damage = [&](const std::string& dataset, auto spoil) {
    const std::string text = complaint(path(), spoil);
    EXPECT_NE(text.find("A02"), std::string::npos) << dataset << text;
    EXPECT_NE(text.find(dataset), std::string::npos) << text;
  };
  const double infinity = std::numeric_limits<double>::infinity();
  expect_damage("bbox_min", [infinity](Slices& s) { s.bbox_min.x() = -infinity; });
  expect_damage("bbox_min", [](Slices& s) { s.bbox_max.y() = 9e5; });
  expect_damage("bbox_min", [](Slices& s) { std::swap(s.bbox_min, s.bbox_max); });
  expect_damage("tau", [](Slices& s) { s.tau_m = 1e-9; });
  expect_damage("density", [](Slices& s) { s.density = 1e308; });
  expect_damage("histogram/area", [](Slices& s) { s.histogram.area_m2[1] = -1; });
  expect_damage("levels/z", [](Slices& s) { s.levels[2].z = 1e300; });
  expect_damage("levels/lo", [](Slices& s) { s.levels[0].lo = 1; });
}

TEST_F(SlicesIo, AMissingFileIsNamed) {
  try {
    read_slices(path());
    FAIL() << "no error";
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems().front().code.id, "A01");
  }
}

TEST_F(SlicesIo, PlanesThatNoBuildingHasAreDamage) {
  const auto expect_damage = [&](const std::string& dataset, auto spoil) {
    const std::string text = complaint(path(), spoil);
    EXPECT_NE(text.find("A02"), std::string::npos) << dataset << text;
    EXPECT_NE(text.find(dataset), std::string::npos) << text;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_damage("planes/gradient", [nan](Slices& s) { s.planes[0].gradient.y() = nan; });
  expect_damage("planes/gradient", [](Slices& s) { s.planes[0].gradient.x() = 1e9; });
  expect_damage("planes/c", [](Slices& s) { s.planes[1].c = 1e12; });
  expect_damage("planes/area", [](Slices& s) { s.planes[1].area_m2 = -1; });
  expect_damage("planes/rms", [nan](Slices& s) { s.planes[0].rms_m = nan; });
  expect_damage("planes/outline_x", [](Slices& s) { s.planes[0].outline[1].x() = 1e9; });
  expect_damage("planes/outline_offset", [](Slices& s) { s.planes[1].outline.pop_back(); });
  expect_damage("planes/outline_x",
                [](Slices& s) { std::swap(s.planes[0].outline[0], s.planes[0].outline[1]); });
  expect_damage("planes/outline_x",
                [](Slices& s) { std::reverse(s.planes[1].outline.begin(), s.planes[1].outline.end()); });
}

}  // namespace
}  // namespace roomcut
