// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "common/params/params.h"

namespace roomcut {

namespace {

constexpr double kRadPerDegree = std::numbers::pi / 180.0;

/// Shortest text that reads back as the same number.
std::string number_text(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

[[noreturn]] void must_be(const std::string& what) {
  throw std::invalid_argument("must be " + what);
}

/// "012" is ten in YAML 1.1 and twelve to a person.
bool has_leading_zero(const std::string& text) {
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  return text.size() > first + 1 && text[first] == '0' && text[first + 1] >= '0' && text[first + 1] <= '9';
}

template <class T>
bool parse_whole(const std::string& text, T& value) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end && !has_leading_zero(text);
}

double parse_number(const std::string& text, double lowest, double highest, const std::string& wanted) {
  double value = 0;
  if (!parse_whole(text, value) || !std::isfinite(value) || value < lowest || value > highest) {
    must_be(wanted);
  }
  return value;
}

std::string range_text(double lowest, double highest) {
  return number_text(lowest) + " … " + number_text(highest);
}

std::string wanted_text(const Parameter& p) {
  std::string text = (p.type == "integer" ? "a whole number, " : "a number, ") + p.range;
  if (p.unit != "1") {
    text += " " + p.unit;
  }
  return p.may_be_auto ? text + ", or auto" : text;
}

Parameter describe(std::string name, std::string unit, std::string type, double lowest, double highest,
                   std::string description) {
  Parameter p;
  p.name = std::move(name);
  p.unit = std::move(unit);
  p.type = std::move(type);
  p.lowest = lowest;
  p.highest = highest;
  p.range = range_text(lowest, highest);
  p.description = std::move(description);
  return p;
}

/// The default is the value that the field has when the parameter is made.
void take_default(Parameter& p) {
  p.default_text = p.get();
  if (p.default_text.size() >= 2 && p.default_text.front() == '"') {
    p.default_text = p.default_text.substr(1, p.default_text.size() - 2);
  }
  try {
    p.set(p.default_text);
  } catch (const std::invalid_argument& error) {
    throw std::logic_error("default of " + p.name + ": " + error.what());
  }
}

}  // namespace

Parameter number(std::string name, double& field, std::string unit, double lowest, double highest,
                 std::string description) {
  Parameter p = describe(std::move(name), std::move(unit), "number", lowest, highest, std::move(description));
  p.set = [&field, lowest, highest, wanted = wanted_text(p)](const std::string& text) {
    field = parse_number(text, lowest, highest, wanted);
  };
  p.get = [&field] { return number_text(field); };
  take_default(p);
  return p;
}

Parameter angle(std::string name, double& field_rad, double lowest_deg, double highest_deg,
                std::string description) {
  Parameter p = describe(std::move(name), "deg", "number", lowest_deg, highest_deg, std::move(description));
  // The degrees are kept beside the radians: 15 stays 15 and not 15.000000000000002 on the way back.
  const auto degrees = std::make_shared<double>(std::round(field_rad / kRadPerDegree * 1e9) / 1e9);
  p.set = [&field_rad, degrees, lowest_deg, highest_deg, wanted = wanted_text(p)](const std::string& text) {
    *degrees = parse_number(text, lowest_deg, highest_deg, wanted);
    field_rad = *degrees * kRadPerDegree;
  };
  p.get = [degrees] { return number_text(*degrees); };
  take_default(p);
  return p;
}

Parameter auto_number(std::string name, std::optional<double>& field, std::string unit, double lowest,
                      double highest, std::string description, std::string formula) {
  Parameter p = describe(std::move(name), std::move(unit), "number", lowest, highest, std::move(description));
  p.may_be_auto = true;
  p.formula = std::move(formula);
  p.set = [&field, lowest, highest, wanted = wanted_text(p)](const std::string& text) {
    if (text == "auto") {
      field.reset();
    } else {
      field = parse_number(text, lowest, highest, wanted);
    }
  };
  p.get = [&field] { return field ? number_text(*field) : std::string("\"auto\""); };
  take_default(p);
  return p;
}

Parameter integer(std::string name, int& field, std::string unit, int lowest, int highest,
                  std::string description) {
  Parameter p =
      describe(std::move(name), std::move(unit), "integer", lowest, highest, std::move(description));
  p.range = std::to_string(lowest) + " … " + std::to_string(highest);
  p.set = [&field, lowest, highest, wanted = wanted_text(p)](const std::string& text) {
    int value = 0;
    if (!parse_whole(text, value) || value < lowest || value > highest) {
      must_be(wanted);
    }
    field = value;
  };
  p.get = [&field] { return std::to_string(field); };
  take_default(p);
  return p;
}

Parameter boolean(std::string name, bool& field, std::string description) {
  Parameter p = describe(std::move(name), "1", "boolean", 0, 1, std::move(description));
  p.range = "true, false";
  p.set = [&field](const std::string& text) {
    if (text != "true" && text != "false") {
      must_be("true or false");
    }
    field = text == "true";
  };
  p.get = [&field] { return std::string(field ? "true" : "false"); };
  take_default(p);
  return p;
}

Parameter choice(std::string name, std::string& field, std::vector<std::string> choices,
                 std::string description) {
  Parameter p = describe(std::move(name), "1", "choice", 0, 0, std::move(description));
  p.choices = std::move(choices);
  p.range.clear();
  for (const std::string& word : p.choices) {
    p.range += (p.range.empty() ? "" : ", ") + word;
  }
  p.set = [&field, words = p.choices, list = p.range](const std::string& text) {
    for (const std::string& word : words) {
      if (word == text) {
        field = text;
        return;
      }
    }
    must_be("one of " + list);
  };
  p.get = [&field] { return "\"" + field + "\""; };
  take_default(p);
  return p;
}

}  // namespace roomcut
