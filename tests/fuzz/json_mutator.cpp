// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/json_mutator.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <vector>

namespace roomcut::fuzz {

using Json = nlohmann::json;

namespace {

/// Stands in the dumped text for what JSON values of the library cannot hold.
constexpr const char* kMark = "@@mark@@";

struct Node {
  Json* home;  ///< object or array
  std::string key;
  std::size_t index;
};

void collect(Json& value, std::vector<Node>& nodes) {
  if (value.is_object()) {
    for (auto& [key, child] : value.items()) {
      nodes.push_back({&value, key, 0});
      collect(child, nodes);
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      nodes.push_back({&value, "", i});
      collect(value[i], nodes);
    }
  }
}

/// Texts that stand for a value; some are no JSON.
std::string some_text(std::minstd_rand& draw) {
  static constexpr std::array kTexts{"null",
                                     "true",
                                     "false",
                                     "0",
                                     "-0.0",
                                     "1",
                                     "-1",
                                     "1e308",
                                     "-1e308",
                                     "1e400",
                                     "1e-320",
                                     "4294967296",
                                     "2147483648",
                                     "-2147483649",
                                     "9223372036854775808",
                                     "18446744073709551616",
                                     "NaN",
                                     "Infinity",
                                     "\"\"",
                                     "\"word\"",
                                     "\"nan\"",
                                     "\"\\u0000\"",
                                     "\"\\ud800\"",
                                     "[]",
                                     "{}",
                                     "[null]",
                                     "[[]]",
                                     "[1,2]",
                                     "[1,2,3]",
                                     "{\"\":0}",
                                     "1e6",
                                     "0.1"};
  const auto way = draw() % 12;
  if (way == 0) {
    const std::size_t depth = std::array{10, 70, 3000}[draw() % 3];
    return std::string(depth, '[') + std::string(draw() % 4 == 0 ? 0 : depth, ']');
  }
  if (way == 1) {
    return std::to_string(static_cast<int>(draw() % 20000) - 10000);
  }
  return kTexts[draw() % kTexts.size()];
}

}  // namespace

std::string mutated_json(std::string_view text, std::size_t size_limit, std::minstd_rand& draw) {
  const auto shallow = [](int depth, Json::parse_event_t, Json&) {
    if (depth > 200) {
      throw std::length_error("deep");
    }
    return true;
  };
  Json tree;
  try {
    tree = Json::parse(text.begin(), text.end(), shallow);
  } catch (const std::exception&) {
    return "";
  }
  std::vector<Node> nodes;
  collect(tree, nodes);
  if (nodes.empty()) {
    return "";
  }
  const Node node = nodes[draw() % nodes.size()];
  Json& home = *node.home;
  Json& value = home.is_object() ? home[node.key] : home[node.index];
  std::string stands_for = some_text(draw);
  switch (draw() % 8) {
    case 0:
      if (home.is_object()) {
        home.erase(node.key);
      } else {
        home.erase(node.index);
      }
      break;
    case 1:  // a node of the file in another place
    {
      const Node other = nodes[draw() % nodes.size()];
      const Json copy = other.home->is_object() ? (*other.home)[other.key] : (*other.home)[other.index];
      value = copy;
      break;
    }
    case 2:
      if (home.is_object()) {  // the key twice
        home[kMark] = value;
        stands_for = Json(node.key).dump(-1, ' ', false, Json::error_handler_t::replace);
      } else {
        home.push_back(Json(value));
      }
      break;
    default:
      value = kMark;
  }
  std::string out = tree.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string mark = Json(kMark).dump();
  if (const std::size_t at = out.find(mark); at != std::string::npos) {
    out.replace(at, mark.size(), stands_for);
  }
  return out.size() <= size_limit ? out : "";
}

}  // namespace roomcut::fuzz
