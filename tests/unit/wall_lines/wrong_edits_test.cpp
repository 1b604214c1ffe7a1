// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>
#include <sstream>

#include "common/errors/codes.h"
#include "common/errors/error.h"
#include "tests/unit/wall_lines/lines_fixture.h"

namespace roomcut {
namespace {

using testing::Folder;

const std::filesystem::path kEdits = testing::kSource / "tests/data/edits";

std::vector<Problem> problems_of(const std::filesystem::path& path) {
  const WallLines base = read_wall_lines(testing::kFirstVersion).content;
  try {
    read_edited_wall_lines(path, base);
  } catch (const StageError& error) {
    return error.problems();
  }
  return {};
}

TEST(WrongEdits, EachFileGivesTheOneErrorThatItIsNamedAfterWithAPlaceAndARemedy) {
  std::set<std::string> messages;
  std::set<std::string> codes;
  for (const auto& entry : std::filesystem::directory_iterator(kEdits)) {
    const std::string name = entry.path().filename().string();
    if (name.front() != 'L') {
      continue;
    }
    const std::vector<Problem> problems = problems_of(entry.path());
    ASSERT_EQ(problems.size(), 1U) << name;
    EXPECT_EQ(problems[0].code.id, name.substr(0, 3)) << name << ": " << problems[0].what;
    EXPECT_EQ(problems[0].code.exit_code, ExitCode::kInput);
    EXPECT_NE(problems[0].where.find(name), std::string::npos) << name;
    EXPECT_FALSE(problems[0].hint.empty()) << name;
    EXPECT_TRUE(messages.insert(problems[0].what).second) << name << " says what another file says";
    codes.insert(problems[0].code.id);
  }
  EXPECT_GE(messages.size(), 20U);
  EXPECT_GE(codes.size(), 12U);
}

TEST(WrongEdits, AllProblemsOfAFileAreListedAtOnceWithFeatureAndId) {
  const std::vector<Problem> problems = problems_of(kEdits / "many_problems.geojson");
  ASSERT_EQ(problems.size(), 5U);
  std::set<std::string> codes;
  std::string all;
  for (const Problem& problem : problems) {
    codes.insert(problem.code.id);
    all += to_string(problem);
  }
  EXPECT_EQ(codes, (std::set<std::string>{"L05", "L06", "L07", "L08", "L09"}));
  EXPECT_NE(all.find("features[2] (wall_id w0017)"), std::string::npos) << all;
  EXPECT_NE(all.find("features[5]"), std::string::npos) << all;
}

/// A feature with one more property.
std::string edit_with(const std::string& property) {
  return R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {)" + property +
         R"(}, "geometry": {"type": "LineString", "coordinates": [[0, 0], [1, 0]]}}]})";
}

TEST(WrongEdits, DeepNestingIsAnErrorOfTheFileAndNotOfTheProgram) {
  const Folder folder;
  for (const std::string& nested : {std::string(50'000, '[') + std::string(50'000, ']'), [] {
                                      std::string text = "1";
                                      for (int i = 0; i < 3000; ++i) text = R"({"k": 1, "k": )" + text + "}";
                                      return text;
                                    }()}) {
    const std::vector<Problem> problems =
        problems_of(testing::save(folder / "deep.geojson", edit_with(R"("x": )" + nested)));
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_STREQ(problems[0].code.id, "L01");
    EXPECT_NE(problems[0].what.find("deeper"), std::string::npos) << problems[0].what;
  }
}

TEST(WrongEdits, ManyRepeatedKeysAndLongValuesMakeFewAndShortMessages) {
  const Folder folder;
  std::string keys = R"("locked": ")" + std::string(1'000'000, 'x') + R"(")";
  for (int i = 0; i < 10'000; ++i) keys += R"(, "k)" + std::to_string(i / 2) + R"(": 1)";
  const std::vector<Problem> problems = problems_of(testing::save(folder / "keys.geojson", edit_with(keys)));
  EXPECT_LE(problems.size(), 21U);
  std::size_t bytes = 0;
  for (const Problem& problem : problems) bytes += to_string(problem).size();
  EXPECT_LT(bytes, 10'000U);
}

TEST(WrongEdits, HugeCoordinatesLieOutsideTheScan) {
  const Folder folder;
  std::string text = edit_with("");
  text.replace(text.find("[1, 0]"), 6, "[1e308, -1e308]");
  const std::vector<Problem> problems = problems_of(testing::save(folder / "huge.geojson", text));
  ASSERT_FALSE(problems.empty());
  EXPECT_STREQ(problems[0].code.id, "L08");
}

TEST(WrongEdits, TheCauseIsNamed) {
  EXPECT_NE(problems_of(kEdits / "L08_degrees.geojson")[0].what.find("degrees"), std::string::npos);
  EXPECT_NE(problems_of(kEdits / "L08_millimetres.geojson")[0].what.find("millimetres"), std::string::npos);
  EXPECT_NE(problems_of(kEdits / "L08_scan_coordinates.geojson")[0].hint.find("\"scan\""), std::string::npos);
  EXPECT_NE(problems_of(kEdits / "L08_local_coordinates.geojson")[0].hint.find("\"local\""),
            std::string::npos);
  EXPECT_NE(problems_of(kEdits / "L01_trailing_comma.geojson")[0].what.find("line 5"), std::string::npos);
  EXPECT_NE(problems_of(kEdits / "L10_key_twice.geojson")[0].where.find("features[1].properties"),
            std::string::npos);
}

TEST(WrongEdits, AFolderOrAnAbsentFileCannotBeRead) {
  const Folder folder;
  for (const auto& path : {folder / "", folder / "absent.geojson"}) {
    const std::vector<Problem> problems = problems_of(path);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_STREQ(problems[0].code.id, "L13");
  }
}

TEST(WrongEdits, AWholePlanOnOneSpotWasSavedInDegrees) {
  const Folder folder;
  const auto path = testing::save(folder / "tiny.geojson", R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[-0.003, -0.003], [0.003, -0.003]]}},
    {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[-0.003, -0.003], [-0.003, 0.003]]}}]})");
  const std::vector<Problem> problems = problems_of(path);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_STREQ(problems[0].code.id, "L08");
  EXPECT_NE(problems[0].what.find("degrees"), std::string::npos);
}

TEST(WrongEdits, TheListInTheReadmeIsTheFolder) {
  std::ostringstream readme;
  readme << std::ifstream(kEdits / "README.md").rdbuf();
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kEdits)) {
    if (entry.path().extension() == ".geojson") {
      ++files;
      EXPECT_NE(readme.str().find("`" + entry.path().filename().string() + "`"), std::string::npos)
          << entry.path();
    }
  }
  std::size_t rows = 0;
  for (std::size_t at = readme.str().find("\n| `"); at != std::string::npos;
       at = readme.str().find("\n| `", at + 1)) {
    ++rows;
  }
  EXPECT_EQ(rows, files);
}

}  // namespace
}  // namespace roomcut
