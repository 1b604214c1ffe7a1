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

/// Behind a back a thin cell is a wall, unless it has a ceiling or a floor of its own: a room's rim behind a
/// cupboard.
double behind(const CellEvidence& e) {
  const double plate = e.thin() * (1 - e.flat);
  return (1 + plate) * e.around.near_back;
}

struct Feature {
  const char* name;
  double (*of)(const CellEvidence&);
};

constexpr std::array<Feature, kFeatures> kFeature{{
    {"own_fronts", [](const CellEvidence& e) { return e.front_m2 / surface_m2(e); }},
    {"own_backs_thin", [](const CellEvidence& e) { return e.thin() * e.back_m2 / surface_m2(e); }},
    {"own_backs_wide", [](const CellEvidence& e) { return (1 - e.thin()) * e.back_m2 / surface_m2(e); }},
    {"fronts_around", [](const CellEvidence& e) { return e.around.front; }},
    {"behind", behind},
    {"in_slab", [](const CellEvidence& e) { return e.in_slab(); }},
    {"open", [](const CellEvidence& e) { return e.open(); }},
    {"outdoors", [](const CellEvidence& e) { return e.outdoors(); }},
    {"sky", [](const CellEvidence& e) { return e.sky; }},
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
