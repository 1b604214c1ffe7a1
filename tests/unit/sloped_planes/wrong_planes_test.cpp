// SPDX-License-Identifier: GPL-3.0-or-later
#include <functional>
#include <set>

#include "common/errors/error.h"
#include "tests/unit/sloped_planes/planes_fixture.h"

namespace roomcut {
namespace {

using nlohmann::json;
using testing::document;
using testing::drawn;

std::vector<Problem> problems_of(const std::string& text) {
  try {
    testing::edited_text(text);
  } catch (const StageError& error) {
    return error.problems();
  }
  return {};
}

struct Wrong {
  const char* code;
  std::function<void(json&)> change;
};

json& first(json& document) {
  return document["features"][0];
}
json& corner(json& document) {
  return first(document)["geometry"]["coordinates"][0][0];
}

const std::vector<Wrong> kWrong = {
    {"L02", [](json& d) { d["type"] = "Feature"; }},
    {"L03", [](json& d) { d["roomcut"]["artefact"] = "wall_lines"; }},
    {"L04", [](json& d) { d["roomcut"]["schema_version"] = "1.9"; }},
    {"L05", [](json& d) { first(d)["geometry"]["type"] = "LineString"; }},
    {"L05", [](json& d) { first(d)["geometry"] = nullptr; }},
    {"L05",
     [](json& d) {
       json& geometry = first(d)["geometry"];
       geometry["type"] = "MultiPolygon";
       geometry["coordinates"] = json::array({geometry["coordinates"], geometry["coordinates"]});
     }},
    {"L06", [](json& d) { corner(d)[0] = "east"; }},
    {"L06",
     [](json& d) {
       first(d)["geometry"]["coordinates"][0] = json::array({corner(d), corner(d)});
     }},
    {"L07",
     [](json& d) {
       first(d) = drawn({{1, 1}, {1.05, 1}, {1.05, 1.05}, {1, 1.05}}, first(d)["properties"]);
     }},
    {"L08", [](json& d) { corner(d)[0] = corner(d)[0].get<double>() + 80; }},
    {"L08", [](json& d) { first(d)["properties"]["height_m"] = 3250; }},
    {"L08", [](json& d) { first(d)["properties"]["pitch_deg"] = 86; }},
    {"L09", [](json& d) { first(d)["properties"]["pitch_deg"] = "steep"; }},
    {"L09", [](json& d) { first(d)["properties"]["pitch_deg"] = 90; }},
    {"L09", [](json& d) { first(d)["properties"]["uphill_deg"] = 400; }},
    {"L09", [](json& d) { first(d)["properties"]["side"] = "roof"; }},
    {"L09", [](json& d) { first(d)["properties"]["locked"] = "perhaps"; }},
    {"L09", [](json& d) { first(d)["properties"]["plane_id"] = json::array({1}); }},
    {"L09",
     [](json& d) {
       first(d) = drawn({{1, 1}, {3, 1}, {3, 5}}, {{"pitch_deg", 45}, {"uphill_deg", 0}});
     }},
    {"L11", [](json& d) { d["roomcut"]["length_unit"] = "ft"; }},
    {"L11", [](json& d) { d["roomcut"]["frame"]["up"] = "y"; }},
    {"L11", [](json& d) { d["roomcut"]["coordinates"] = "lat/lon"; }},
};

TEST(WrongPlanes, EachGivesOneErrorWithItsCodeAPlaceAndARemedy) {
  std::set<std::string> said;
  for (std::size_t i = 0; i < kWrong.size(); ++i) {
    json copy = document();
    kWrong[i].change(copy);
    const std::vector<Problem> problems = problems_of(copy.dump());
    ASSERT_EQ(problems.size(), 1U) << i << " " << kWrong[i].code;
    EXPECT_STREQ(problems[0].code.id, kWrong[i].code) << i << ": " << problems[0].what;
    EXPECT_EQ(problems[0].code.exit_code, ExitCode::kInput);
    EXPECT_NE(problems[0].where.find("edit.geojson"), std::string::npos) << problems[0].where;
    EXPECT_FALSE(problems[0].hint.empty()) << problems[0].what;
    EXPECT_EQ(to_string(problems[0]).find(" lines"), std::string::npos)
        << "speaks of lines: " << to_string(problems[0]);
    said.insert(problems[0].what);
  }
  EXPECT_GE(said.size(), kWrong.size() - 2);
}

TEST(WrongPlanes, TextThatIsNoJsonOrSaysAKeyTwiceIsRefused) {
  const std::string good = document().dump();
  ASSERT_EQ(problems_of(good.substr(0, good.size() / 2)).size(), 1U);
  EXPECT_STREQ(problems_of(good.substr(0, good.size() / 2))[0].code.id, "L01");
  std::string twice = good;
  twice.replace(twice.find("\"locked\":false"), 14, "\"locked\":false,\"locked\":true");
  ASSERT_EQ(problems_of(twice).size(), 1U);
  EXPECT_STREQ(problems_of(twice)[0].code.id, "L10");
  try {
    read_edited_planes(testing::Folder() / "none.geojson", testing::gable());
    FAIL() << "was read";
  } catch (const StageError& error) {
    EXPECT_STREQ(error.problems()[0].code.id, "L13");
  }
}

TEST(WrongPlanes, AllProblemsOfAFileAreListedAtOnceWithFeatureAndId) {
  json copy = document();
  copy["roomcut"]["length_unit"] = "ft";
  corner(copy)[1] = "north";
  copy["features"][1]["properties"]["pitch_deg"] = 95;
  copy["features"][2]["properties"]["height_m"] = 4000;
  copy["features"].push_back(drawn({{1, 1}, {3, 1}, {3, 5}}, json::object()));
  std::multiset<std::string> codes;
  std::string all;
  for (const Problem& problem : problems_of(copy.dump())) {
    codes.insert(problem.code.id);
    all += to_string(problem);
  }
  EXPECT_EQ(codes, (std::multiset<std::string>{"L06", "L08", "L09", "L09", "L09", "L09", "L11"})) << all;
  for (const char* place : {"features[0] (plane_id p0001)", "features[1] (plane_id p0002)",
                            "features[2] (plane_id p0003)", "features[3]: property pitch_deg is missing"}) {
    EXPECT_NE(all.find(place), std::string::npos) << all;
  }
}

}  // namespace
}  // namespace roomcut
