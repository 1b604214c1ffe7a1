// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/accuracy/learn/lesson.h"

#include <algorithm>
#include <cmath>

#include "common/cells/evidence_io.h"
#include "common/cells/interfaces.h"
#include "stages/graphcut/max_flow.h"

namespace roomcut::learn {
namespace {

constexpr double kWall = 4;    // a lost wall costs this many times its volume: it merges rooms
constexpr double kThin = 0.5;  // DataTerms::thin of what is a wall
constexpr double kHalf = 0.5;  // of a cell's volume: the truth's label

bool is_empty_in_truth(double empty, double sampled) {
  return empty > kHalf * sampled;
}

/// Whether a solid, thin cell has rooms on more than one side.
std::vector<std::uint8_t> walls_between(const CellComplex& complex, const std::vector<float>& thin,
                                        const std::vector<double>& empty,
                                        const std::vector<double>& sampled) {
  std::vector<std::uint8_t> rooms(complex.cells(), 0);
  for_each_interface(complex, [&](const Interface& face) {
    for (const auto& [cell, other] : {std::pair(face.a, face.b), std::pair(face.b, face.a)}) {
      if (cell >= 0 && other >= 0) {
        const auto o = static_cast<std::size_t>(other);
        const bool room = is_empty_in_truth(empty[o], sampled[o]);
        auto& count = rooms[static_cast<std::size_t>(cell)];
        count = static_cast<std::uint8_t>(std::min(2, count + (room ? 1 : 0)));
      }
    }
  });
  std::vector<std::uint8_t> between(complex.cells(), 0);
  for (std::size_t c = 0; c < between.size(); ++c) {
    between[c] = rooms[c] > 1 && thin[c] > kThin && !is_empty_in_truth(empty[c], sampled[c]) ? 1 : 0;
  }
  return between;
}

}  // namespace

Lesson::Lesson(const LessonFiles& files) : building_(files.building), made_up_(files.made_up) {
  CellsFile cells = read_cells(files.cells);
  const FaceWeights weights = read_weights(files.weights, cells);
  DataTerms terms = read_data_terms(files.terms, cells);
  const H5Reader truth = open_for_cells(files.truth, artefacts::kTruthCells, cells);
  sampled_ = truth.read<double>("cell/sampled", {cells.complex.cells()});
  truth_ = truth.read<double>("cell/empty", {cells.complex.cells()});
  const std::size_t count = cells.complex.cells();
  // The volume's part of the data term is what is learned; own faces keep theirs.
  for (std::size_t c = 0; c < count; ++c) {
    const double volume = cells.complex.volume(c), beta = terms.beta[c];
    terms.d_empty[c] = std::max(0.0, terms.d_empty[c] - volume * (1 - beta));
    terms.d_solid[c] = std::max(0.0, terms.d_solid[c] - volume * beta);
  }
  faces_ = graphcut::energy_terms(cells.complex, weights, terms, {});
  names_.emplace_back("constant");
  features_.resize(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(terms.features.size() + 1));
  features_.col(0).setOnes();
  for (std::size_t f = 0; f < terms.features.size(); ++f) {
    names_.push_back(terms.features[f].name);
    features_.col(static_cast<Eigen::Index>(f + 1)) =
        Eigen::Map<const Eigen::VectorXf>(terms.features[f].value.data(), static_cast<Eigen::Index>(count));
  }
  const std::vector<std::uint8_t> between = walls_between(cells.complex, terms.thin, truth_, sampled_);
  for (std::size_t c = 0; c < count; ++c) {
    truth_m3_ += truth_[c];
    const double sure = std::abs(2 * truth_[c] - sampled_[c]);
    cost_.push_back((between[c] != 0 ? kWall : 1) * sure);
  }
  complex_ = std::move(cells.complex);
}

std::vector<std::uint8_t> Lesson::labels(const Eigen::VectorXd& weights) const {
  const Eigen::VectorXf odds = features_ * weights.cast<float>();
  graphcut::EnergyTerms energy = faces_;
  const double quantum = graphcut::EnergyTerms::kQuantum_m3;
  for (std::size_t c = 0; c < complex_.cells(); ++c) {
    const double beta = 1 / (1 + std::exp(-static_cast<double>(odds[static_cast<Eigen::Index>(c)])));
    const double volume = complex_.volume(c);
    energy.d_empty[c] += std::nearbyint(volume * (1 - beta) / quantum) * quantum;
    energy.d_solid[c] += std::nearbyint(volume * beta / quantum) * quantum;
  }
  return graphcut::minimum_cut(complex_, energy).label;
}

double Lesson::loss(const Eigen::VectorXd& weights) const {
  const std::vector<std::uint8_t> label = labels(weights);
  double wrong = 0;
  for (std::size_t c = 0; c < label.size(); ++c) {
    wrong += is_empty(label, c) != is_empty_in_truth(truth_[c], sampled_[c]) ? cost_[c] : 0;
  }
  return wrong / truth_m3_;
}

double Lesson::iou(const Eigen::VectorXd& weights) const {
  const std::vector<std::uint8_t> label = labels(weights);
  double common = 0;
  double both = truth_m3_;
  for (std::size_t c = 0; c < label.size(); ++c) {
    common += is_empty(label, c) ? truth_[c] : 0;
    both += is_empty(label, c) ? sampled_[c] - truth_[c] : 0;
  }
  return common / both;
}

}  // namespace roomcut::learn
