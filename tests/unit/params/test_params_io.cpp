// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "common/errors/error.h"
#include "common/params/params.h"
#include "tests/unit/artefact/temporary_folder.h"

namespace roomcut::test {

namespace {

struct Params {
  double mu_m = 0.3;
  std::optional<double> step_m;
  int rays = 64;
  bool enabled = true;
  std::string mode = "fast";
  double angle_rad = 0.0;

  ParameterTable table() {
    return {number("mu_m", mu_m, "m", 0.001, 10, "Price of a face."),
            auto_number("step_m", step_m, "m", 0.01, 1, "Width of a step.", "2 x noise"),
            integer("rays", rays, "1", 1, 1000, "Rays a cell."),
            boolean("enabled", enabled, "Whether it runs."),
            choice("mode", mode, {"fast", "exact"}, "How."),
            angle("angle_deg", angle_rad, 0, 90, "Slope.")};
  }
};

class ParamsIo : public ::testing::Test {
 protected:
  /// The problems that reading `yaml` gives, as printed.
  std::string errors_of(const std::string& yaml) {
    put_bytes(folder_ / "pipeline.yaml", yaml);
    std::string text;
    params = Params();
    table = params.table();
    code = code_of([&] { load_yaml(folder_ / "pipeline.yaml", "graphcut", table); }, &text);
    return text;
  }
  std::size_t count(const std::string& text, const std::string& word) {
    std::size_t n = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      ++n;
    }
    return n;
  }
  TemporaryFolder folder_;
  Params params;
  ParameterTable table = params.table();
  std::string code;
};

}  // namespace

TEST_F(ParamsIo, reads_its_own_block_and_leaves_the_rest_at_the_defaults) {
  EXPECT_EQ(
      errors_of(
          "slice:\n  anything: [1, 2]\ngraphcut:  # a comment\n  mu_m: 0.5\n  step_m: 0.1\n  mode: exact\n"
          "  enabled: false\n  angle_deg: 45\n"),
      "");
  EXPECT_EQ(params.mu_m, 0.5);
  EXPECT_EQ(params.step_m, 0.1);
  EXPECT_EQ(params.rays, 64);
  EXPECT_EQ(params.mode, "exact");
  EXPECT_FALSE(params.enabled);
  EXPECT_DOUBLE_EQ(params.angle_rad, 0.78539816339744828);
}

TEST_F(ParamsIo, takes_empty_files_and_empty_blocks_as_defaults) {
  for (const char* yaml : {"", "# nothing\n", "graphcut:\n", "slice:\n  x: 1\n", "graphcut: {}\n"}) {
    EXPECT_EQ(errors_of(yaml), "") << yaml;
    EXPECT_EQ(params_json(table), params_json(Params().table())) << yaml;
  }
}

TEST_F(ParamsIo, lists_all_problems_with_line_and_dotted_path) {
  const std::string text = errors_of(
      "graphcut:\n  mu_m: abc\n  raise: 1\n  rays: 2.5\n  rays: 3\n  step_m: 5\n  mode:\n  enabled: "
      "[true]\nwalls:\n  x: 1\n");
  EXPECT_EQ(count(text, "error["), 8U) << text;
  for (const char* part :
       {"pipeline.yaml:2: graphcut.mu_m: must be a number, 0.001 … 10 m; it is \"abc\"", "error[U03] ",
        "pipeline.yaml:3: graphcut.raise: there is no such parameter", "pipeline.yaml:4: graphcut.rays",
        "pipeline.yaml:5: graphcut.rays: the key stands twice, first in line 4",
        "pipeline.yaml:6: graphcut.step_m", "pipeline.yaml:7: graphcut.mode: must be one of fast, exact",
        "pipeline.yaml:8: graphcut.enabled", "pipeline.yaml:9: walls: there is no such stage"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
  }
}

TEST_F(ParamsIo, refuses_a_block_that_stands_twice) {
  const std::string text = errors_of("graphcut:\n  mu_m: 1\ngraphcut:\n  mu_m: 2\n");
  EXPECT_EQ(code, "U03");
  EXPECT_NE(text.find("pipeline.yaml:3: graphcut: the block stands twice, first in line 1"),
            std::string::npos)
      << text;
}

TEST_F(ParamsIo, refuses_numbers_that_yaml_would_read_in_its_own_way) {
  for (const char* bad : {"010", "0x1", ".nan", ".inf", "1_0", "0b1", "1:30", "~", "null", "yes"}) {
    errors_of(std::string("graphcut:\n  mu_m: ") + bad + "\n");
    EXPECT_EQ(code, "U04") << bad;
    errors_of(std::string("graphcut:\n  rays: ") + bad + "\n");
    EXPECT_EQ(code, "U04") << bad;
  }
}

TEST_F(ParamsIo, refuses_files_that_are_not_blocks) {
  for (const char* bad :
       {"graphcut:\n mu_m: 1\n  rays: 2\n", "- a\n- b\n", "word\n", "graphcut: [\n", "\tgraphcut: 1\n"}) {
    errors_of(bad);
    EXPECT_EQ(code, "U02") << bad;
  }
  errors_of("graphcut: 3\n");
  EXPECT_EQ(code, "U04");
  errors_of("graphcut:\n  - mu_m\n");
  EXPECT_EQ(code, "U04");
}

TEST_F(ParamsIo, a_missing_file_is_an_error_of_usage) {
  EXPECT_EQ(code_of([&] { load_yaml(folder_ / "none.yaml", "graphcut", table); }), "U02");
  EXPECT_EQ(code_of([&] { load_dump(folder_ / "none.json", "graphcut", table); }), "U02");
}

TEST_F(ParamsIo, dump_does_not_depend_on_order_comments_or_spelling) {
  errors_of("graphcut:\n  rays: 7\n  mu_m: 0.50\n");
  const std::string one = dump_params("graphcut", 4, table);
  errors_of("# a comment\nslice: {x: 1}\ngraphcut: {mu_m: 5e-1, rays: 7, mode: 'fast'}\n");
  EXPECT_EQ(dump_params("graphcut", 4, table), one);
  EXPECT_EQ(one,
            "{\"params\":{\"angle_deg\":0,\"enabled\":true,\"mode\":\"fast\",\"mu_m\":0.5,\"rays\":7,\"step_"
            "m\":\"auto\"},"
            "\"revision\":4,\"stage\":\"graphcut\"}\n");
}

TEST_F(ParamsIo, dump_reads_back_to_the_same_values) {
  errors_of(
      "graphcut: {mu_m: 0.1234567890123, rays: 7, step_m: 0.07, mode: exact, enabled: false, angle_deg: "
      "33.3}\n");
  put_bytes(folder_ / "graphcut.json", dump_params("graphcut", 1, table));
  Params other;
  ParameterTable other_table = other.table();
  load_dump(folder_ / "graphcut.json", "graphcut", other_table);
  EXPECT_EQ(params_json(other_table), params_json(table));
  EXPECT_EQ(other.mu_m, params.mu_m);
  EXPECT_EQ(other.angle_rad, params.angle_rad);
}

TEST_F(ParamsIo, dump_of_another_stage_or_with_missing_or_unknown_keys_is_refused) {
  const auto code_for = [&](const std::string& text) {
    put_bytes(folder_ / "p.json", text);
    return code_of([&] { load_dump(folder_ / "p.json", "graphcut", table); });
  };
  EXPECT_EQ(code_for(dump_params("slice", 1, table)), "U02");
  EXPECT_EQ(code_for("{\"params\":{"), "U02");
  EXPECT_EQ(code_for("{\"params\":{},\"revision\":1,\"stage\":\"graphcut\"}"), "U04");
  std::string more = dump_params("graphcut", 1, table);
  more.insert(more.find("\"angle"), "\"alpha\":1,");
  EXPECT_EQ(code_for(more), "U03");
}

TEST_F(ParamsIo, set_takes_key_and_stage_key) {
  set_parameter("mu_m=0.7", "graphcut", table);
  EXPECT_EQ(params.mu_m, 0.7);
  set_parameter("graphcut.mu_m=0.8", "graphcut", table);
  EXPECT_EQ(params.mu_m, 0.8);
  EXPECT_EQ(code_of([&] { set_parameter("mu_m", "graphcut", table); }), "U01");
  EXPECT_EQ(code_of([&] { set_parameter("mu=1", "graphcut", table); }), "U03");
  EXPECT_EQ(code_of([&] { set_parameter("slice.mu_m=1", "graphcut", table); }), "U03");
  EXPECT_EQ(code_of([&] { set_parameter("mu_m=one", "graphcut", table); }), "U04");
}

TEST_F(ParamsIo, help_names_every_parameter_with_default_unit_and_range) {
  const std::string help = parameter_help(table);
  for (const Parameter& p : table) {
    EXPECT_NE(help.find("  " + p.name + ": " + p.default_text), std::string::npos) << p.name;
    EXPECT_NE(help.find(p.description), std::string::npos) << p.name;
  }
  EXPECT_NE(help.find("0.01 … 1 m, or auto: 2 x noise"), std::string::npos);
}

TEST_F(ParamsIo, yaml_block_reads_back_to_the_same_values) {
  errors_of("graphcut: {mu_m: 0.25, mode: exact, enabled: false, angle_deg: 12.5}\n");
  const std::string before = params_json(table);
  const std::string block = parameter_yaml("graphcut", "The cut", table);
  EXPECT_EQ(errors_of(block), "");
  EXPECT_EQ(params_json(table), before);
  EXPECT_NE(block.find("  # Width of a step [0.01 … 1 m, or auto: 2 x noise]\n  step_m: auto\n"),
            std::string::npos)
      << block;
  EXPECT_EQ(parameter_yaml("accept_lines", "The door", {}), "# The door\naccept_lines:  # no parameters\n");
}

TEST(KnownStages, are_those_of_the_pipeline_in_its_order) {
  EXPECT_EQ(known_stages().front(), "ingest");
  EXPECT_EQ(known_stages().size(), 16U);
}

}  // namespace roomcut::test
