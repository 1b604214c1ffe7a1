// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/features.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "common/text/words.h"

namespace roomcut::raycast {
namespace {

/// A few stray points on a large cell's faces should not decide: they count against this much of its surface.
constexpr double kStray_m2 = 0.5, kStrayShare = 0.03;

double surface_m2(const CellEvidence& e) {
  return e.front_m2 + e.back_m2 + kStray_m2 + kStrayShare * e.total_m2;
}

double own_fronts(const CellEvidence& e) {
  return e.front_m2 / surface_m2(e);
}

double own_backs(const CellEvidence& e) {
  return e.back_m2 / surface_m2(e);
}

/// 1 where rays meet backs as close by as inside a wall, 0 where as far as from the middle of a narrow room.
double within_a_wall(const CellEvidence& e) {
  constexpr double kRoom = 0.12, kWall = 0.32;  // share of the rays, fading: 2.5 m, 0.6 m wide
  return std::clamp((e.around.near_back - kRoom) / (kWall - kRoom), 0.0, 1.0);
}

/// A back close by on the level and neither floor nor ceiling: a wall of which the other side was not seen. A
/// room's rim behind a cupboard has a ceiling.
double behind(const CellEvidence& e) {
  return e.level.near_back * (1 - std::max(e.up.front, e.down.front));
}

struct Feature {
  const char* name;
  double (*of)(const CellEvidence&);
};

constexpr std::array<Feature, kFeatures> kFeature{{
    {"own_fronts", own_fronts},
    {"own_backs", own_backs},
    {"own_backs_in_wall", [](const CellEvidence& e) { return own_backs(e) * within_a_wall(e); }},
    {"fronts_around", [](const CellEvidence& e) { return e.around.front; }},
    {"backs_close", [](const CellEvidence& e) { return e.around.near_back; }},
    {"behind", behind},
    {"in_slab", [](const CellEvidence& e) { return e.in_slab(); }},
    {"between_rooms", [](const CellEvidence& e) { return e.across.backs_wide; }},
    {"in_wall", [](const CellEvidence& e) { return e.across.backs_thin; }},
    {"wall_goes_on", [](const CellEvidence& e) { return e.wall_goes_on; }},
    {"open", [](const CellEvidence& e) { return e.across.open(); }},
    {"open_across", [](const CellEvidence& e) { return e.across.both_open; }},
    {"between_storeys", [](const CellEvidence& e) { return e.upright.backs_thin; }},
    {"low", [](const CellEvidence& e) { return e.upright.front_back_low; }},
    {"floor_and_ceiling", [](const CellEvidence& e) { return e.upright.fronts; }},
    {"storey_between", [](const CellEvidence& e) { return e.upright.backs_wide; }},
    {"back_below", [](const CellEvidence& e) { return e.down.back; }},
    {"back_above", [](const CellEvidence& e) { return e.up.back; }},
    {"sky", [](const CellEvidence& e) { return e.sky; }},
    {"sky_open", [](const CellEvidence& e) { return e.sky * e.across.open(); }},
    {"outdoors", [](const CellEvidence& e) { return e.upright.both_open; }},
    {"outdoors_open", [](const CellEvidence& e) { return e.upright.both_open * e.across.open(); }},
    {"beyond", [](const CellEvidence& e) { return e.beyond; }},
    {"beyond_unseen", [](const CellEvidence& e) { return e.beyond * (1 - e.around.front); }},
    {"looked_through", [](const CellEvidence& e) { return e.looked_through(); }},
}};

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("weights.table: " + what);
}

FeatureWeight parse_line(std::string_view line) {
  const std::vector<std::string_view> column = split(line, '|');
  std::string rest;
  double weight = 0;
  std::istringstream number(std::string(column.size() == 3 ? column[1] : ""));
  number.imbue(std::locale::classic());
  if (!(number >> weight) || number >> rest || column[2].empty() || !std::isfinite(weight)) {
    refuse("not 'feature | weight | meaning': " + std::string(line));
  }
  return {std::string(column[0]), weight, std::string(column[2])};
}

std::size_t place_of(const std::string& name) {
  const auto* found = std::find_if(kFeature.begin(), kFeature.end(),
                                   [&](const Feature& feature) { return name == feature.name; });
  if (found == kFeature.end()) {
    refuse("no feature is called " + name);
  }
  return static_cast<std::size_t>(found - kFeature.begin());
}

}  // namespace

double FeatureWeights::log_odds(const FeatureValues& values) const {
  double sum = constant;
  for (std::size_t i = 0; i < kFeatures; ++i) {
    sum += features[i].weight * values[i];
  }
  return sum;
}

FeatureWeights parse_weights(const std::string& text) {
  FeatureWeights weights;
  std::array<bool, kFeatures> given{};
  bool constant = false;
  for (const std::string_view line : split(text, '\n')) {
    if (line.empty() || line.front() == '#') {
      continue;
    }
    if (constexpr std::string_view kSource = "source:"; line.starts_with(kSource)) {
      weights.source = trimmed(line.substr(kSource.size()));
      continue;
    }
    const FeatureWeight parsed = parse_line(line);
    const bool is_constant = parsed.name == "constant";
    bool& before = is_constant ? constant : given[place_of(parsed.name)];
    if (before) {
      refuse("given twice: " + parsed.name);
    }
    before = true;
    if (is_constant) {
      weights.constant = parsed.weight;
    } else {
      weights.features[place_of(parsed.name)] = parsed;
    }
  }
  if (!constant || weights.source.empty()) {
    refuse("without a constant or a source");
  }
  if (const auto* missing = std::find(given.begin(), given.end(), false); missing != given.end()) {
    refuse(std::string("without ") + kFeature[static_cast<std::size_t>(missing - given.begin())].name);
  }
  return weights;
}

const FeatureWeights& shipped_weights() {
  static const FeatureWeights kWeights = parse_weights(
#include "weights_table.inc"
  );
  return kWeights;
}

FeatureValues features_of(const CellEvidence& evidence) {
  FeatureValues values;
  std::transform(kFeature.begin(), kFeature.end(), values.begin(),
                 [&](const Feature& feature) { return feature.of(evidence); });
  return values;
}

}  // namespace roomcut::raycast
