// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include "common/params/params.h"

namespace roomcut::test {

TEST(Parameter, number_takes_plain_decimal_numbers_of_its_range_only) {
  double mu = 0.3;
  const Parameter p = number("mu_m", mu, "m", 0.001, 10, "Price of a face.");
  for (const auto& [text, value] :
       {std::pair{"0.001", 0.001}, {"10", 10.0}, {"1e-3", 0.001}, {"2.5E0", 2.5}}) {
    p.set(text);
    EXPECT_EQ(mu, value) << text;
  }
  p.set("0.3");
  for (const char* bad :
       {"",     " 1",  "1 ",   "1,5",   "+1",         "abc",       "auto", "nan",   "inf",  "-inf", ".nan",
        "0x10", "010", "00.5", "1_000", "0.00099999", "10.000001", "-1",   "1e999", "true", "~"}) {
    EXPECT_THROW(p.set(bad), std::invalid_argument) << bad;
    EXPECT_EQ(mu, 0.3) << bad;
  }
}

TEST(Parameter, number_prints_the_shortest_text_that_reads_back) {
  double value = 0.1;
  const Parameter p = number("x", value, "1", 0, 1e9, "");
  for (const char* text : {"0.1", "0.30000000000000004", "1e-07", "123456789", "0"}) {
    p.set(text);
    EXPECT_EQ(p.get(), text);
  }
}

TEST(Parameter, angle_is_in_degrees_outside_and_radians_inside) {
  double angle_rad = 15.0 * std::numbers::pi / 180.0;
  const Parameter p = angle("merge_angle_deg", angle_rad, 0.1, 90, "");
  EXPECT_EQ(p.get(), "15");
  EXPECT_EQ(p.default_text, "15");
  const double from_default = angle_rad;
  p.set("15");
  EXPECT_EQ(angle_rad, from_default) << "the default and the same value written out must be the same bits";
  p.set("90");
  EXPECT_DOUBLE_EQ(angle_rad, std::numbers::pi / 2);
  EXPECT_THROW(p.set("90.1"), std::invalid_argument);
}

TEST(Parameter, auto_is_taken_only_where_it_is_allowed) {
  std::optional<double> width;
  const Parameter p = auto_number("bandwidth_m", width, "m", 0.001, 0.1, "", "");
  EXPECT_EQ(p.get(), "\"auto\"");
  EXPECT_EQ(p.default_text, "auto");
  p.set("0.02");
  EXPECT_EQ(width, 0.02);
  EXPECT_EQ(p.get(), "0.02");
  p.set("auto");
  EXPECT_FALSE(width.has_value());
  EXPECT_THROW(p.set("Auto"), std::invalid_argument);
  EXPECT_THROW(p.set("0.2"), std::invalid_argument);
}

TEST(Parameter, integer_takes_whole_numbers_only) {
  int rays = 64;
  const Parameter p = integer("rays", rays, "1", 1, 1000, "");
  p.set("128");
  EXPECT_EQ(rays, 128);
  for (const char* bad : {"1.0", "1e2", "0", "1001", "99999999999999999999", "012", "", "auto", "0x1"}) {
    EXPECT_THROW(p.set(bad), std::invalid_argument) << bad;
  }
  EXPECT_EQ(rays, 128);
}

TEST(Parameter, boolean_and_choice_take_their_words_only) {
  bool enabled = true;
  std::string mode = "prior";
  const Parameter b = boolean("enabled", enabled, "");
  const Parameter c = choice("edited_lines", mode, {"prior", "locked", "free"}, "");
  b.set("false");
  c.set("free");
  EXPECT_FALSE(enabled);
  EXPECT_EQ(c.get(), "\"free\"");
  for (const char* bad : {"True", "yes", "1", "off", ""}) {
    EXPECT_THROW(b.set(bad), std::invalid_argument) << bad;
  }
  EXPECT_THROW(c.set("Prior"), std::invalid_argument);
  EXPECT_THROW(c.set(""), std::invalid_argument);
}

TEST(Parameter, a_default_outside_its_own_range_is_a_bug_that_shows_at_once) {
  double value = 11;
  EXPECT_THROW(number("x", value, "m", 0, 10, ""), std::logic_error);
}

}  // namespace roomcut::test
