// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/graphcut/doubt.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/cells/cell_pieces.h"
#include "stages/graphcut/max_flow.h"

namespace roomcut::graphcut {

namespace {

constexpr double kSeen = 0.7;                 // of a room with a scanner in it more was seen
constexpr double kClosed = 0.8, kOpen = 0.3;  // a room with windows and doors; a yard between buildings
constexpr double kLeaky = 0.7;                // from here on a room is doubtful for its openness
constexpr double kWallThickness_m = 0.4;      // 2 V / A of what is no space, but a wall or a slab
constexpr double kSurest = 1e-6;              // probabilities are stored in floats

/// By how much the probability of being empty changes with the log-odds.
double change(double beta, double log_odds) {
  const double sure = std::clamp(beta, kSurest, 1 - kSurest);
  return 1 / (1 + (1 - sure) / sure * std::exp(-log_odds)) - sure;
}

enum class End { kInvented, kDenied };

/// The cut with all cells at one end of their doubt.
std::vector<std::uint8_t> cut_at(End end, const CellComplex& complex, const DataTerms& terms,
                                 const EnergyTerms& energy, double doubt) {
  EnergyTerms shifted = energy;
  for (std::size_t c = 0; c < complex.cells(); ++c) {
    const Doubt of_cell = doubt_of(terms.seen_inside(c), terms.closed[c], doubt);
    const double gain = quantised(
        complex.volume(c) * change(terms.beta[c], end == End::kDenied ? of_cell.denied : -of_cell.invented));
    shifted.d_empty[c] -= std::min(gain, shifted.d_empty[c]);
    shifted.d_solid[c] += std::max(gain, -shifted.d_solid[c]);
  }
  return minimum_cut(complex, shifted).label;
}

/// Whether the pieces are wider than walls and slabs.
std::vector<bool> find_wide(const CellComplex& complex, const CellPieces& pieces) {
  const auto count = static_cast<std::size_t>(pieces.count);
  std::vector<double> volume(count), area(count);
  const auto piece_of = [&](std::int64_t cell) {
    return cell < 0 ? -1 : pieces.of_cell[static_cast<std::size_t>(cell)];
  };
  for (std::size_t c = 0; c < complex.cells(); ++c) {
    if (pieces.of_cell[c] >= 0) {
      volume[static_cast<std::size_t>(pieces.of_cell[c])] += complex.volume(c);
    }
  }
  for_each_interface(complex, [&](const Interface& face) {
    const std::int32_t a = piece_of(face.a);
    const std::int32_t b = piece_of(face.b);
    if (a != b && a >= 0) area[static_cast<std::size_t>(a)] += face.area;
    if (a != b && b >= 0) area[static_cast<std::size_t>(b)] += face.area;
  });
  std::vector<bool> wide(count);
  for (std::size_t i = 0; i < count; ++i) {
    wide[i] = 2 * volume[i] > kWallThickness_m * area[i];
  }
  return wide;
}

/// What is left of a room between unknown cells and is no wider than a wall goes with them.
void take_slivers(const CellComplex& complex, std::vector<std::uint8_t>& label) {
  const CellPieces pieces = connected_pieces(
      complex, [&](std::size_t cell) { return is_empty(label, cell); },
      [](const Interface&) { return true; });
  const std::vector<bool> wide = find_wide(complex, pieces);
  std::vector<bool> taken(wide.size(), false);
  for_each_interface(complex, [&](const Interface& face) {
    for (const auto& [cell, other] : {std::pair{face.a, face.b}, std::pair{face.b, face.a}}) {
      if (is_empty(label, cell) && other >= 0 && is_unknown(label, static_cast<std::size_t>(other))) {
        const auto piece = static_cast<std::size_t>(pieces.of_cell[static_cast<std::size_t>(cell)]);
        taken[piece] = !wide[piece];
      }
    }
  });
  for (std::size_t c = 0; c < complex.cells(); ++c) {
    if (pieces.of_cell[c] >= 0 && taken[static_cast<std::size_t>(pieces.of_cell[c])]) {
      label[c] = Label::kUnknown;
    }
  }
}

}  // namespace

Doubt doubt_of(double seen, double closed, double doubt) {
  const double unseen = doubt * std::max(0.0, 1 - seen / kSeen);
  const double open = std::clamp((kClosed - closed) / (kClosed - kLeaky), 0.0, 1.0);
  return {0.5 * unseen * open, unseen * std::clamp((closed - kOpen) / (kClosed - kOpen), 0.0, 1.0)};
}

std::vector<std::uint8_t> doubtful_labels(const CellComplex& complex, const FaceWeights& weights,
                                          const DataTerms& terms, const EnergyTerms& energy,
                                          const std::vector<std::uint8_t>& cut, double doubt) {
  const std::vector<std::uint8_t> least = cut_at(End::kInvented, complex, terms, energy, doubt);
  const std::vector<std::uint8_t> most = cut_at(End::kDenied, complex, terms, energy, doubt);
  const CellPieces pieces = connected_pieces(
      complex, [&](std::size_t cell) { return least[cell] != most[cell]; },
      [&](const Interface& face) {
        return face.wall ? !weights.is_wall(face.index) : !weights.is_level(face.index);
      });
  const std::vector<bool> wide = find_wide(complex, pieces);
  std::vector<std::uint8_t> label = cut;
  for (std::size_t c = 0; c < complex.cells(); ++c) {
    if (pieces.of_cell[c] >= 0 && wide[static_cast<std::size_t>(pieces.of_cell[c])]) {
      label[c] = Label::kUnknown;
    }
  }
  take_slivers(complex, label);
  return label;
}

}  // namespace roomcut::graphcut
