// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/text_names.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace roomcut::ingest {

namespace {

constexpr int kCartesian = 0;  // x, y, z
constexpr int kGrid = 1;       // easting, northing
constexpr int kHeight = 2;     // height, with either
constexpr int kNormal = 3;

struct KnownName {
  std::string_view name;
  int kind;
  int role;
};

constexpr std::array<KnownName, 30> kGridNames{
    {{"easting", kGrid, 0},  {"eastings", kGrid, 0},    {"east", kGrid, 0},     {"e", kGrid, 0},
     {"utme", kGrid, 0},     {"rechtswert", kGrid, 0},  {"rechts", kGrid, 0},   {"rw", kGrid, 0},
     {"ostwert", kGrid, 0},  {"ost", kGrid, 0},         {"northing", kGrid, 1}, {"northings", kGrid, 1},
     {"north", kGrid, 1},    {"n", kGrid, 1},           {"utmn", kGrid, 1},     {"hochwert", kGrid, 1},
     {"hoch", kGrid, 1},     {"hw", kGrid, 1},          {"nordwert", kGrid, 1}, {"nord", kGrid, 1},
     {"height", kHeight, 2}, {"elevation", kHeight, 2}, {"elev", kHeight, 2},   {"altitude", kHeight, 2},
     {"alt", kHeight, 2},    {"h", kHeight, 2},         {"up", kHeight, 2},     {"hoehe", kHeight, 2},
     {"hohe", kHeight, 2},   {"hhe", kHeight, 2}}};  // Höhe without its umlaut

/// Words that may stand before or behind the letter of an axis.
constexpr std::array<std::string_view, 14> kAxisWords{
    "",           "pos",    "position",   "p",         "point", "pt",     "coord",
    "coordinate", "coords", "koordinate", "cartesian", "world", "global", "local"};
constexpr std::array<std::string_view, 9> kUnits{"m",      "mm",    "cm",     "ft",   "feet",
                                                 "metres", "meter", "meters", "metre"};
constexpr std::array<std::string_view, 4> kNormalWords{"n", "normal", "norm", "nornormal"};

bool is_one_of(std::string_view word, const auto& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

KnownName known_name(const std::string& name) {
  const auto* const grid = std::find_if(kGridNames.begin(), kGridNames.end(),
                                        [&](const KnownName& known) { return known.name == name; });
  if (grid != kGridNames.end()) {
    return *grid;
  }
  for (int axis = 0; axis < 3 && !name.empty(); ++axis) {
    const char letter = "xyz"[axis];
    for (const bool behind : {true, false}) {
      if ((behind ? name.back() : name.front()) != letter) {
        continue;
      }
      const std::string_view rest = std::string_view(name).substr(behind ? 0 : 1, name.size() - 1);
      if (is_one_of(rest, kNormalWords)) {
        return {"", kNormal, 3 + axis};
      }
      if (is_one_of(rest, kAxisWords)) {
        return {"", kCartesian, axis};
      }
    }
  }
  return {"", kCartesian, kNoRole};
}

/// How often each role is named, by kind.
using Tally = std::array<std::array<int, 6>, 4>;

/// The kind whose x and y are each named once; `unclear` says why there is none when some are named.
int plan_kind(const Tally& tally, std::string& unclear) {
  const auto once = [&](int kind) {
    return tally[static_cast<std::size_t>(kind)][0] == 1 && tally[static_cast<std::size_t>(kind)][1] == 1;
  };
  if (once(kCartesian) && once(kGrid)) {
    unclear = "two sets of coordinates are named";
    return -1;
  }
  for (const int kind : {kCartesian, kGrid}) {
    if (once(kind)) {
      return kind;
    }
    const auto& named = tally[static_cast<std::size_t>(kind)];
    if (named[0] > 1 || named[1] > 1) {
      unclear = "a coordinate is named twice";
    }
  }
  return -1;
}

}  // namespace

std::string bare_name(std::string_view name) {
  std::string bare;
  std::string tail;  // what stands behind the last gap
  for (const char c : name.substr(0, name.find_first_of("([", 0))) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      bare += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      tail += bare.back();
    } else if (c == ' ' || c == '_' || c == '.' || c == '/') {
      tail.clear();
    }
  }
  if (tail.size() < bare.size() && is_one_of(tail, kUnits)) {
    bare.resize(bare.size() - tail.size());
  }
  return bare;
}

bool only_units(const Fields& names) {
  return std::all_of(names.begin(), names.end(), [](std::string_view name) {
    const std::string bare = bare_name(unquoted(name));
    return bare.empty() || is_one_of(bare, kUnits);
  });
}

bool NamedColumns::found() const {
  return std::count(roles.begin(), roles.end(), 0) == 1;
}

NamedColumns columns_of_names(const Fields& names) {
  NamedColumns result;
  result.roles.assign(names.size(), kNoRole);
  std::vector<KnownName> known;
  Tally tally{};
  for (const std::string_view name : names) {
    known.push_back(known_name(bare_name(unquoted(name))));
    if (known.back().role != kNoRole) {
      ++tally[static_cast<std::size_t>(known.back().kind)][static_cast<std::size_t>(known.back().role)];
      result.known = true;
    }
  }
  const int plan = plan_kind(tally, result.unclear);
  const int up = tally[kCartesian][2] > 0 ? kCartesian : kHeight;
  const int heights = tally[static_cast<std::size_t>(up)][2];
  if (plan >= 0 && heights != 1) {
    result.unclear = heights == 0 ? "no height is named" : "the height is named twice";
  }
  if (plan < 0 || heights != 1) {
    return result;
  }
  const auto& normal = tally[kNormal];
  const bool normals = normal[3] == 1 && normal[4] == 1 && normal[5] == 1;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const auto [name, kind, role] = known[i];
    if ((kind == plan && role < 2) || (kind == up && role == 2) || (kind == kNormal && normals)) {
      result.roles[i] = role;
    }
  }
  return result;
}

}  // namespace roomcut::ingest
