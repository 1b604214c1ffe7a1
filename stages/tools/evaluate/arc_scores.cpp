// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/arc_scores.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace roomcut::evaluate {

namespace {

constexpr double kNear_m = 0.03;
constexpr double kShare = 0.6;
constexpr int kPlaces = 50;  // along an arc

bool covers(const DescribedArc& arc, const Vec2& p) {
  const Vec2 out = p - arc.centre;
  double turn = std::atan2(out.y(), out.x()) - arc.from;
  turn -= 2 * std::numbers::pi * std::floor(turn / (2 * std::numbers::pi));
  return turn <= arc.sweep && std::abs(out.norm() - arc.radius_m) <= kNear_m;
}

/// Share of the truth's arc that the model's follows; 0 when they lie at other heights.
double followed(const DescribedArc& truth, const DescribedArc& model) {
  const double common = std::min(truth.z1, model.z1) - std::max(truth.z0, model.z0);
  if (common < 0.5 * (truth.z1 - truth.z0)) return 0;
  int on = 0;
  for (int k = 0; k < kPlaces; ++k) {
    const double angle = truth.from + truth.sweep * (k + 0.5) / kPlaces;
    on += covers(model, truth.centre + truth.radius_m * Vec2(std::cos(angle), std::sin(angle))) ? 1 : 0;
  }
  return static_cast<double>(on) / kPlaces;
}

std::optional<double> share(std::size_t part, std::size_t whole) {
  return whole > 0 ? std::optional(static_cast<double>(part) / static_cast<double>(whole)) : std::nullopt;
}

}  // namespace

bool ArcScores::Arc::close() const {
  return found && std::abs(radius_error_m) <= std::max(0.005, 0.002 * radius_m);
}

std::size_t ArcScores::found() const {
  return static_cast<std::size_t>(
      std::count_if(arcs.begin(), arcs.end(), [](const Arc& arc) { return arc.found; }));
}

std::size_t ArcScores::close() const {
  return static_cast<std::size_t>(
      std::count_if(arcs.begin(), arcs.end(), [](const Arc& arc) { return arc.close(); }));
}

std::optional<double> ArcScores::precision() const {
  return share(found(), found() + false_arcs);
}
std::optional<double> ArcScores::recall() const {
  return share(found(), arcs.size());
}
std::optional<double> ArcScores::f1() const {
  return share(2 * found(), found() + false_arcs + arcs.size());
}

ArcScores score_arcs(const std::vector<DescribedArc>& truth, const std::vector<DescribedArc>& model) {
  ArcScores scores;
  for (const DescribedArc& arc : truth) scores.arcs.push_back({arc.radius_m});
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;  // minus the share, truth, model
  for (std::size_t t = 0; t < truth.size(); ++t) {
    for (std::size_t m = 0; m < model.size(); ++m) {
      const double on = followed(truth[t], model[m]);
      if (on >= kShare) pairs.emplace_back(-on, t, m);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> taken(model.size(), false);
  for (const auto& [minus_share, t, m] : pairs) {
    ArcScores::Arc& arc = scores.arcs[t];
    if (arc.found || taken[m]) continue;
    taken[m] = true;
    arc.found = true;
    arc.radius_error_m = model[m].radius_m - truth[t].radius_m;
    arc.centre_error_m = (model[m].centre - truth[t].centre).norm();
  }
  scores.false_arcs = static_cast<std::size_t>(std::count(taken.begin(), taken.end(), false));
  return scores;
}

}  // namespace roomcut::evaluate
