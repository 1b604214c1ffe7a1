// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/wall_lines/wall_lines_io.h"

#include <numbers>
#include <sstream>

#include "common/artefact/artefact_check.h"
#include "common/artefact/h5.h"
#include "common/artefact/json_values.h"
#include "common/artefact_digest/artefact_digest.h"
#include "common/errors/codes.h"
#include "common/errors/error.h"
#include "common/wall_lines/compare_lines.h"
#include "tests/unit/wall_lines/lines_fixture.h"

namespace roomcut {
namespace {

using testing::Folder;
using testing::line_of;
using testing::make_line;
using testing::save;

WallLines example() {
  WallLines lines;
  lines.frame.origin[0] = 500000.125;
  lines.bbox_min = {-1, -1};
  lines.bbox_max = {5, 4};
  lines.base_sha256 = std::string(64, 'a');
  lines.lines = {make_line("w0002", {4, 3}, {0, 3.0000004}), make_line("w0001", {0, 0}, {4, 0})};
  WallLine& second = lines.lines[0];
  second.source = LineSource::kRefined;
  second.locked = true;
  second.levels = std::vector<int>{1, 2};
  second.support_m = 3.25;
  second.rms_m = 0.004;
  second.sigma_offset_m = 0.0003;
  second.sigma_angle_rad = 0.05 * std::numbers::pi / 180;
  second.note = "a \"note\"\nof two lines";
  second.extra_json = R"({"colour":"red","n":[1,2]})";
  return lines;
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(WallLinesIo, EverythingComesBackSortedByIdWithSixDecimals) {
  const Folder folder;
  Provenance made;
  made.stage = "detect_lines";
  made.params_json = "{}";
  write_wall_lines(folder / "lines.geojson", example(), made);
  const WallLinesFile file = read_wall_lines(folder / "lines.geojson");
  ASSERT_EQ(file.content.lines.size(), 2U);
  EXPECT_EQ(file.content.lines[0].id, "w0001");
  const WallLine& second = file.content.lines[1];
  EXPECT_EQ(second.a, Vec2(0, 3));
  EXPECT_EQ(second.b, Vec2(4, 3));
  EXPECT_EQ(second.source, LineSource::kRefined);
  EXPECT_TRUE(second.locked);
  EXPECT_EQ(second.levels, (std::vector<int>{1, 2}));
  EXPECT_DOUBLE_EQ(second.support_m, 3.25);
  EXPECT_DOUBLE_EQ(second.rms_m, 0.004);
  EXPECT_DOUBLE_EQ(second.sigma_offset_m, 0.0003);
  EXPECT_NEAR(second.sigma_angle_rad, example().lines[0].sigma_angle_rad, 1e-12);
  EXPECT_EQ(second.note, example().lines[0].note);
  EXPECT_EQ(second.extra_json, example().lines[0].extra_json);
  EXPECT_FALSE(file.content.lines[0].levels.has_value());
  EXPECT_EQ(file.content.frame.origin[0], 500000.125);
  EXPECT_EQ(file.content.bbox_max, Vec2(5, 4));
  EXPECT_EQ(file.content.base_sha256, std::string(64, 'a'));
  EXPECT_EQ(file.provenance.stage, "detect_lines");
}

TEST(WallLinesIo, OneLinePerWallSoThatADiffShowsOneLine) {
  const Folder folder;
  WallLines lines = example();
  write_wall_lines(folder / "a.geojson", lines, {});
  lines.lines[1].b.y() += 0.1;
  write_wall_lines(folder / "b.geojson", lines, {});
  std::istringstream a(text_of(folder / "a.geojson"));
  std::istringstream b(text_of(folder / "b.geojson"));
  std::string line_a;
  std::string line_b;
  int different = 0;
  while (std::getline(a, line_a) && std::getline(b, line_b)) {
    const bool differs = line_a != line_b && line_a.find("provenance") == std::string::npos;
    different += differs ? 1 : 0;
  }
  EXPECT_EQ(different, 1);
}

TEST(WallLinesIo, TheDigestKnowsLinesButNeitherProvenanceNorBaseNorDirection) {
  WallLines lines = example();
  const std::string digest = wall_lines_payload_sha256(lines);
  std::swap(lines.lines[0], lines.lines[1]);
  std::swap(lines.lines[0].a, lines.lines[0].b);
  lines.base_sha256 = "other";
  lines.lines[1].a.x() += 1e-8;
  EXPECT_EQ(wall_lines_payload_sha256(lines), digest);
  lines.lines[1].locked = false;
  EXPECT_NE(wall_lines_payload_sha256(lines), digest);
}

TEST(WallLinesIo, EqualPayloadKeepsTheTimeAndSaysSo) {
  const Folder folder;
  const auto path = folder / "lines.geojson";
  EXPECT_TRUE(write_wall_lines(path, example(), {}));
  const auto old = std::filesystem::file_time_type::clock::now() - std::chrono::hours(5);
  std::filesystem::last_write_time(path, old);
  Provenance made;
  made.stage = "another";
  EXPECT_FALSE(write_wall_lines(path, example(), made));
  EXPECT_EQ(std::filesystem::last_write_time(path), old);
  EXPECT_EQ(read_wall_lines(path).provenance.stage, "another");
}

TEST(WallLinesIo, StatesItsPayloadForTheStagesAfterIt) {
  const Folder folder;
  write_wall_lines(folder / "lines.geojson", example(), {});
  const InputRecord record = inspect_artefact(folder / "lines.geojson");
  EXPECT_EQ(record.artefact, "wall_lines");
  EXPECT_EQ(record.payload_sha256, wall_lines_payload_sha256(example()));
}

TEST(WallLinesIo, TheStrictReaderRefusesWhatAStageWouldNotWrite) {
  const Folder folder;
  write_wall_lines(folder / "lines.geojson", example(), {});
  const std::string good = text_of(folder / "lines.geojson");
  const auto code_with = [&](const std::string& from, const std::string& to) -> std::string {
    std::string text = good;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    try {
      read_wall_lines(save(folder / "bad.geojson", text));
    } catch (const StageError& error) {
      return error.problems().front().code.id;
    }
    return "none";
  };
  EXPECT_EQ(code_with("\"schema_version\": \"1.1\"", "\"schema_version\": \"2.0\""),
            errors::kArtefactVersion.id);
  EXPECT_EQ(code_with("\"artefact\": \"wall_lines\"", "\"artefact\": \"cells\""), errors::kArtefactType.id);
  EXPECT_EQ(code_with("\"wall_id\": \"w0002\"", "\"wall_id\": \"w0001\""), errors::kArtefactDamaged.id);
  EXPECT_EQ(code_with("\"locked\": true", "\"locked\": \"yes\""), errors::kArtefactDamaged.id);
  EXPECT_EQ(code_with("LineString", "Polygon"), errors::kArtefactDamaged.id);
  EXPECT_EQ(code_with("\"roomcut\"", "\"room\""), errors::kArtefactDamaged.id);
  EXPECT_EQ(code_with("[500004.125000, 3.000000]", "[500000.125000, 3.000000]"), errors::kArtefactDamaged.id);
  EXPECT_EQ(code_with("500004.125000, 3.000000", "1e308, 3.000000"), errors::kArtefactDamaged.id);
  EXPECT_EQ(code_with("\"rms_m\": 0.004000", "\"rms_m\": 1e999"), errors::kArtefactDamaged.id);
  EXPECT_EQ(code_with("\"levels\": [1,2]", "\"levels\": [1,2.5]"), errors::kArtefactDamaged.id);
  EXPECT_EQ(
      code_with("[1,2]}, \"geometry\"", std::string(200, '[') + std::string(200, ']') + "}, \"geometry\""),
      errors::kArtefactDamaged.id);
  EXPECT_THROW(read_wall_lines(folder / "absent.geojson"), StageError);
}

TEST(WallLinesIo, AWallMovedInTheFileOfAStageIsRefusedAndTheUserSentToTheEdits) {
  const Folder folder;
  write_wall_lines(folder / "lines.geojson", example(), {});
  std::string text = text_of(folder / "lines.geojson");
  text.replace(text.find("500004.125000, 3.000000"), 13, "500004.225000");
  try {
    read_wall_lines(save(folder / "moved.geojson", text));
    FAIL() << "believed";
  } catch (const StageError& error) {
    const Problem& problem = error.problems().front();
    EXPECT_STREQ(problem.code.id, errors::kArtefactDamaged.id);
    EXPECT_NE(problem.what.find("digest"), std::string::npos) << problem.what;
    EXPECT_NE(problem.hint.find("make run"), std::string::npos) << problem.hint;
    EXPECT_NE(problem.hint.find("edits/wall_lines.geojson"), std::string::npos) << problem.hint;
  }
  EXPECT_THROW(verified_artefact(folder / "moved.geojson"), StageError);
  EXPECT_EQ(verified_artefact(folder / "lines.geojson").payload_sha256, wall_lines_payload_sha256(example()));
}

TEST(WallLinesIo, AFileThatIsNoArtefactIsVerifiedByItsBytes) {
  const Folder folder;
  const InputRecord record = verified_artefact(save(folder / "model.obj", "v 0 0 0\n"));
  EXPECT_EQ(record.artefact, "");
  EXPECT_EQ(record.payload_sha256, sha256_hex("v 0 0 0\n"));
}

TEST(WallLinesIo, NaNIsNeverWritten) {
  const Folder folder;
  WallLines lines = example();
  lines.lines[0].rms_m = std::nan("");
  EXPECT_THROW(write_wall_lines(folder / "nan.geojson", lines, {}), std::logic_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "nan.geojson"));
}

TEST(WallLinesIo, EveryPublishedVersionIsReadableAndTheNewestIsOurs) {
  const auto folder = testing::kSource / "tests/compat";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with("wall_lines_")) {
      ++files;
      const WallLinesFile file = read_wall_lines(entry.path());
      EXPECT_EQ(file.content.lines.size(), 8U) << entry.path();
      EXPECT_NO_THROW(read_edited_wall_lines(entry.path(), file.content)) << entry.path();
    }
  }
  EXPECT_GE(files, 1);
  const std::string newest = "wall_lines_v" + version_text(artefacts::kWallLines) + ".geojson";
  EXPECT_TRUE(std::filesystem::exists(folder / newest)) << "add " << newest << " to tests/compat";
}

TEST(WallLinesIo, TheFirstVersionMeansWhatItMeant) {
  const WallLines lines = read_wall_lines(testing::kFirstVersion).content;
  EXPECT_EQ(lines.frame.origin[1], 447001.25);
  EXPECT_EQ(lines.bbox_min, Vec2(-5.2, -3.2));
  const WallLine& edited = line_of(lines, "w0007");
  EXPECT_EQ(edited.source, LineSource::kEdited);
  EXPECT_TRUE(edited.locked);
  EXPECT_EQ(edited.levels, (std::vector<int>{0, 2}));
  EXPECT_EQ(edited.note, "T\xc3\xbcr \"oben\"");
  EXPECT_EQ(Json::parse(edited.extra_json)["colour"], "red");
  EXPECT_EQ(edited.b, Vec2(5, 1.25));
  EXPECT_EQ(line_of(lines, "e0001").source, LineSource::kAdded);
  EXPECT_NEAR(line_of(lines, "w0001").sigma_offset_m, 0.0004, 1e-12);
}

}  // namespace
}  // namespace roomcut
