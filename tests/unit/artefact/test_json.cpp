// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/json_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/artefact/artefact_check.h"
#include "common/artefact/h5.h"
#include "tests/unit/artefact/temporary_folder.h"

namespace roomcut::test {

TEST(Json, canonical_text_depends_on_the_value_only) {
  EXPECT_EQ(canonical_json(Json::parse(R"({ "b": [1, 2.5],  "a": true })")), R"({"a":true,"b":[1,2.5]})");
}

TEST(Json, refuses_numbers_that_it_would_turn_into_null) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Json value = {{"a", {1.0, bad}}};
    EXPECT_THROW(canonical_json(value), std::logic_error);
    EXPECT_THROW(pretty_json(value), std::logic_error);
  }
}

TEST(Json, keeps_provenance_and_frame) {
  const Provenance provenance{
      "slice", 2, R"({"x":1})", "12", {{"cloud", "cloud", "1.0", "34", "../10_ingest/cloud.h5"}}};
  EXPECT_EQ(to_json(provenance_from_json(to_json(provenance))), to_json(provenance));
  Frame frame;
  frame.origin[1] = 0.1;
  frame.up = "y";
  EXPECT_EQ(to_json(frame_from_json(to_json(frame))), to_json(frame));
  EXPECT_FALSE(to_json(frame).contains("crs")) << "files of before have none";
  frame.crs = "EPSG:25832";
  EXPECT_EQ(frame_from_json(to_json(frame)).crs, frame.crs);
  EXPECT_THROW(provenance_from_json(Json::object()), Json::exception);
}

TEST(ParseJson, refuses_what_is_nested_too_deeply_in_little_time_and_stack) {
  const auto nested = [](int depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_NO_THROW(parse_json(nested(kDeepestJson)));
  EXPECT_THROW(parse_json(nested(kDeepestJson + 1)), BadJson);
  EXPECT_THROW(parse_json(nested(10'000'000)), BadJson);
  EXPECT_NO_THROW(parse_json("{\"a\": \"" + std::string(1000, '[') + "\\\"[[\"}")) << "brackets in texts";
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += R"({"a":)";
  EXPECT_THROW(parse_json(objects), BadJson);
  EXPECT_TRUE(try_parse_json(objects).is_null());
}

TEST(ParseJson, refuses_numbers_and_texts_that_a_program_cannot_hold) {
  EXPECT_THROW(parse_json("[1e999]"), BadJson);
  EXPECT_THROW(parse_json("[\"\xff\"]"), BadJson);
  EXPECT_THROW(parse_json("[NaN]"), BadJson);
  EXPECT_FALSE(is_utf8("\xc3"));
  EXPECT_TRUE(is_utf8("größer"));
}

TEST(ParseJson, numbers_are_asked_for_with_their_range) {
  EXPECT_EQ(number_in(Json(2.5), 0, 3), 2.5);
  EXPECT_EQ(whole_number_in(Json(-3), -3, 3), -3);
  EXPECT_THROW(number_in(Json(3.5), 0, 3), BadJson);
  EXPECT_THROW(number_in(Json("1"), 0, 3), BadJson);
  EXPECT_THROW(whole_number_in(Json(2.5), 0, 3), BadJson);
  EXPECT_THROW(whole_number_in(Json(std::uint64_t{1} << 63), 0, 3), BadJson);
  EXPECT_THROW(local_metres(Json(1e308)), BadJson);
}

TEST(JsonArtefact, with_a_changed_number_is_refused_with_the_way_to_make_it_again) {
  const TemporaryFolder folder;
  const auto path = folder / "summary.json";
  write_json_artefact(path, artefacts::kSummary, {}, {}, {{"area_m2", 12.5}});
  std::string text = bytes_of(path);
  text.replace(text.find("12.5"), 4, "13.5");
  put_bytes(path, text);
  std::string message;
  EXPECT_EQ(code_of([&] { read_json_artefact(path, artefacts::kSummary); }, &message), "A02");
  EXPECT_NE(message.find("digest"), std::string::npos) << message;
  EXPECT_NE(message.find("make run"), std::string::npos) << message;
  EXPECT_EQ(code_of([&] { verified_plain_artefact(path); }), "A02");
  put_bytes(path, text.replace(text.find("13.5"), 4, "1e999"));
  EXPECT_EQ(code_of([&] { read_json_artefact(path, artefacts::kSummary); }), "A02");
  EXPECT_EQ(code_of([&] { read_provenance(path); }, &message), "A02");
  EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
}

TEST(JsonArtefact, returns_what_was_written_and_keeps_the_time_for_an_equal_payload) {
  const TemporaryFolder folder;
  const auto path = folder / "summary.json";
  Provenance provenance{"extract", 1, "{}", "x", {}};
  EXPECT_TRUE(write_json_artefact(path, artefacts::kSummary, provenance, {}, {{"area_m2", 12.5}}));
  EXPECT_EQ(read_json_artefact(path, artefacts::kSummary)["area_m2"], 12.5);
  make_old(path);
  provenance.stage_revision = 2;
  EXPECT_FALSE(write_json_artefact(path, artefacts::kSummary, provenance, {}, {{"area_m2", 12.5}}));
  EXPECT_TRUE(is_old(path));
  EXPECT_EQ(read_json_artefact(path, artefacts::kSummary)["provenance"]["stage_revision"], 2);
  EXPECT_TRUE(write_json_artefact(path, artefacts::kSummary, provenance, {}, {{"area_m2", 12.6}}));
  EXPECT_FALSE(is_old(path));
}

TEST(JsonArtefact, is_inspected_like_an_hdf5_one) {
  const TemporaryFolder folder;
  write_json_artefact(folder / "s.json", artefacts::kSummary, {}, {}, {{"a", 1}});
  const InputRecord record = inspect_artefact(folder / "s.json");
  EXPECT_EQ(record.artefact, "summary");
  EXPECT_EQ(record.schema_version, version_text(artefacts::kSummary));
  EXPECT_EQ(record.payload_sha256.size(), 64U);
  put_bytes(folder / "lines.geojson",
            R"({"type":"FeatureCollection","roomcut":{"artefact":"wall_lines","schema_version":"1.0",
               "provenance":{"payload_sha256":"77"}},"features":[]})");
  EXPECT_EQ(inspect_artefact(folder / "lines.geojson").artefact, "wall_lines");
  EXPECT_EQ(inspect_artefact(folder / "lines.geojson").payload_sha256, "77");
}

TEST(JsonArtefact, of_another_type_or_version_or_damaged_is_refused) {
  const TemporaryFolder folder;
  const auto path = folder / "summary.json";
  write_json_artefact(path, artefacts::kSummary, {}, {}, {{"a", 1}});
  EXPECT_EQ(code_of([&] { read_json_artefact(path, artefacts::kScores); }), "A03");
  EXPECT_EQ(code_of([&] { read_json_artefact(path, {"summary", 2, 0}); }), "A04");
  put_bytes(path, bytes_of(path).substr(0, 40));
  EXPECT_EQ(code_of([&] { read_json_artefact(path, artefacts::kSummary); }), "A02");
  put_bytes(path, "[1]");
  EXPECT_EQ(code_of([&] { read_json_artefact(path, artefacts::kSummary); }), "A02");
  EXPECT_EQ(code_of([&] { read_json_artefact(folder / "none", artefacts::kSummary); }), "A01");
}

}  // namespace roomcut::test
