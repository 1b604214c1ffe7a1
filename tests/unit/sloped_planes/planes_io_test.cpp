// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/types.h"
#include "common/errors/error.h"
#include "tests/unit/sloped_planes/planes_fixture.h"

namespace roomcut {
namespace {

using testing::Folder;
using testing::gable;
using testing::provenance;
using testing::text_of;

const std::filesystem::path kCompat = std::filesystem::path(ROOMCUT_SOURCE_DIR) / "tests/compat";

TEST(PlanesFile, GivesBackWhatWasWrittenAndTheSameBytesAgain) {
  const Folder folder;
  write_planes_file(folder / "a.geojson", gable(), provenance());
  const PlanesFile file = read_planes_file(folder / "a.geojson");
  write_planes_file(folder / "b.geojson", file.content, provenance());
  EXPECT_EQ(text_of(folder / "a.geojson"), text_of(folder / "b.geojson"));
  const AcceptedPlanes base = gable();
  ASSERT_EQ(file.content.planes.size(), base.planes.size());
  for (std::size_t i = 0; i < base.planes.size(); ++i) {
    const SlopedPlane& read = file.content.planes[i].plane;
    const SlopedPlane& plane = base.planes[i].plane;
    EXPECT_EQ(file.content.planes[i].id, base.planes[i].id);
    EXPECT_EQ(read.gradient, plane.gradient);
    EXPECT_EQ(read.c, plane.c);
    EXPECT_EQ(read.outline, plane.outline);
    EXPECT_EQ(read.ceiling, plane.ceiling);
  }
  ASSERT_EQ(file.content.levels.size(), 3U);
  EXPECT_TRUE(file.content.levels[1].step);
  EXPECT_TRUE(file.content.levels[2].cap);
}

TEST(PlanesFile, SaysPitchUphillAndHeightInTheScansOwnCoordinates) {
  const nlohmann::json roof = testing::document()["features"][0]["properties"];
  EXPECT_NEAR(roof["pitch_deg"].get<double>(), 26.565051, 1e-6);
  EXPECT_NEAR(roof["uphill_deg"].get<double>(), 90, 1e-6);
  EXPECT_NEAR(roof["height_m"].get<double>(), 250 + 3.25, 1e-6);
  EXPECT_EQ(roof["side"], "ceiling");
}

TEST(PlanesFile, NormalFormIsReachedInOneStepInAFrameThatWasLevelled) {
  AcceptedPlanes leaning = gable();
  leaning.frame.level[0] = 0.03;
  leaning.frame.level[1] = -0.02;
  leaning.frame.level[2] = std::sqrt(1 - 0.03 * 0.03 - 0.02 * 0.02);
  const AcceptedPlanes once = normalised_planes(leaning);
  EXPECT_EQ(planes_payload_sha256(once), planes_payload_sha256(normalised_planes(once)));
  for (std::size_t i = 0; i < once.planes.size(); ++i) {
    const Vec2 middle = middle_of(leaning.planes[i].plane.outline);
    EXPECT_NEAR(once.planes[i].plane.height(middle), leaning.planes[i].plane.height(middle), 3e-6);
    EXPECT_LT((once.planes[i].plane.gradient - leaning.planes[i].plane.gradient).norm(), 1e-7);
  }
}

TEST(PlanesFile, AChangedNumberIsFoundByTheDigest) {
  const Folder folder;
  nlohmann::json document = testing::document();
  document["features"][0]["properties"]["pitch_deg"] = 30;
  std::ofstream(folder / "changed.geojson") << document.dump();
  try {
    read_planes_file(folder / "changed.geojson");
    FAIL() << "was read";
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems()[0].code.id, "A02");
  }
}

TEST(PlanesFile, EveryVersionOncePublishedIsRead) {
  for (int minor = 0; minor <= artefacts::kPlanes.minor; ++minor) {
    const std::string version = std::to_string(artefacts::kPlanes.major) + "." + std::to_string(minor);
    const PlanesFile file = read_planes_file(kCompat / ("planes_v" + version + ".geojson"));
    EXPECT_GE(file.content.planes.size(), 4U) << version;
    const PlanesFile edit = read_edited_planes(kCompat / ("planes_v" + version + ".geojson"), file.content);
    EXPECT_EQ(edit.payload_sha256.size(), 64U);
    ASSERT_EQ(edit.content.planes.size(), file.content.planes.size());
    for (std::size_t i = 0; i < edit.content.planes.size(); ++i) {
      EXPECT_EQ(edit.content.planes[i].source, file.content.planes[i].source) << version;
      EXPECT_EQ(edit.content.planes[i].plane.outline, file.content.planes[i].plane.outline) << version;
      EXPECT_EQ(edit.content.planes[i].locked, file.content.planes[i].locked) << version;
    }
  }
}

}  // namespace
}  // namespace roomcut
