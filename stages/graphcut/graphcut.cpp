// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/graphcut/graphcut.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "common/cells/interfaces.h"
#include "common/cells/manifold_check.h"
#include "common/errors/codes.h"
#include "stages/graphcut/doubt.h"
#include "stages/graphcut/energy.h"
#include "stages/graphcut/label_repair.h"
#include "stages/graphcut/max_flow.h"

namespace roomcut::graphcut {

namespace {

std::string text(const char* format, double a, double b = 0, double c = 0) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, a, b, c);
  return buffer;
}

bool any_empty(const std::vector<std::uint8_t>& label) {
  return std::find(label.begin(), label.end(), Label::kEmpty) != label.end();
}

/// The labels before the repair, as params.unknown wants them.
std::vector<std::uint8_t> answered(const CellComplex& complex, const FaceWeights& weights,
                                   const DataTerms& terms, const EnergyTerms& energy, const Cut& cut,
                                   const GraphcutParams& params) {
  if (params.unknown == "decided") {
    return cut.label;
  }
  std::vector<std::uint8_t> label = doubtful_labels(complex, weights, terms, energy, cut.label, params.doubt);
  if (params.unknown == "rooms") {
    std::replace(label.begin(), label.end(), Label::kUnknown, Label::kEmpty);
  }
  return label;
}

/// What the repair left solid stays unknown where it was.
void keep_unknown(const std::vector<std::uint8_t>& before, std::vector<std::uint8_t>& label) {
  for (std::size_t c = 0; c < label.size(); ++c) {
    if (is_unknown(before, c) && !is_empty(label, c)) {
      label[c] = Label::kUnknown;
    }
  }
}

/// Says why nothing was worth cutting out: what spoke for empty space, and what the faces were worth.
[[noreturn]] void give_up(const CellComplex& complex, const FaceWeights& weights, const DataTerms& terms,
                          const GraphcutParams& params, double unknown_m3) {
  double leaning = 0;
  double gain = 0;
  for (std::size_t c = 0; c < complex.cells(); ++c) {
    const double cell_gain = terms.d_solid[c] - terms.d_empty[c];
    if (cell_gain > 0) {
      leaning += complex.volume(c);
      gain += cell_gain;
    }
  }
  double covered = 0;
  double area = 0;
  for_each_interface(complex, [&](const Interface& face) {
    covered += face.area * (face.wall ? weights.wall_omega[face.index] : weights.level_omega[face.index]);
    area += face.area;
  });
  throw StageError(
      errors::kEmptyModel, "graphcut",
      std::string(unknown_m3 > 0 ? "no cell is empty: " + text("%.3g m^3 are unknown; ", unknown_m3)
                                 : "every cell is solid: ") +
          text("%.3g m^3 lean towards empty and would gain %.3g m^3 of energy, no surface around them is "
               "that cheap; ",
               leaning, gain) +
          text("%.3g of %.3g m^2 of all faces are covered by points", covered, area),
      unknown_m3 > 0 ? "graphcut.unknown: rooms makes rooms of them; see the pictures of the labels"
      : gain > 0 ? text("lower graphcut.mu_m (now %.3g)", params.mu_m) + "; see the pictures of the data term"
                 : "see the counts of weigh_faces and raycast: no cell has evidence of being a room");
}

void rate_cells(const CellComplex& complex, const EnergyTerms& energy, const DataTerms& terms,
                const GraphcutParams& params, Graphcut& result) {
  Labels& labels = result.labels;
  labels.margin_m3.resize(complex.cells());
  labels.unobserved.resize(complex.cells());
  for (std::size_t c = 0; c < complex.cells(); ++c) {
    labels.margin_m3[c] = static_cast<float>(flip_cost(complex, energy, labels.label, c));
    labels.unobserved[c] = terms.observed[c] < params.min_observed ? 1 : 0;
    if (is_empty(labels.label, c)) {
      const double volume = complex.volume(c);
      ++result.empty_cells;
      result.empty_m3 += volume;
      result.unobserved_empty_m3 += labels.unobserved[c] != 0 ? volume : 0;
    } else if (is_unknown(labels.label, c)) {
      ++result.unknown_cells;
      result.unknown_m3 += complex.volume(c);
    }
  }
}

}  // namespace

Graphcut graphcut(const CellComplex& complex, const FaceWeights& weights, const DataTerms& terms,
                  const GraphcutParams& params) {
  const EnergyTerms energy = energy_terms(complex, weights, terms, params);
  const Cut cut = minimum_cut(complex, energy);
  const ManifoldCheck check(complex);
  std::vector<std::uint8_t> label = answered(complex, weights, terms, energy, cut, params);
  // The scanner stood in some room: where the doubt would leave none, the cut alone decides.
  const bool cut_alone = !any_empty(label) && any_empty(cut.label);
  if (cut_alone) {
    label = cut.label;
  }
  const std::vector<std::uint8_t> model = labels_of_model(label);
  const double before_m3 = energy_of(complex, energy, model).total_m3();
  Repair repair = repair_labels(check, energy, model);
  keep_unknown(label, repair.label);

  Graphcut result;
  result.cut_m3 = cut.flow_m3;
  result.cut_alone = cut_alone;
  result.unknown_added_m3 = before_m3 - cut.flow_m3;
  result.repair_m3 = repair.added_m3;
  result.bad_places = static_cast<std::int64_t>(check.find_all(model).size());
  result.labels.label = std::move(repair.label);
  result.labels.repair_flips = repair.flips;
  const Energy parts = energy_of(complex, energy, result.labels.label);
  result.labels.data_m3 = parts.data_m3;
  result.labels.boundary_m3 = parts.boundary_m3;
  result.labels.energy_m3 = parts.total_m3();
  rate_cells(complex, energy, terms, params, result);
  if (result.empty_cells == 0) {
    give_up(complex, weights, terms, params, result.unknown_m3);
  }
  return result;
}

}  // namespace roomcut::graphcut
