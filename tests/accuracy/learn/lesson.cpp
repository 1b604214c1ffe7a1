// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/accuracy/learn/lesson.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/cells/evidence_io.h"
#include "common/cells/interfaces.h"
#include "stages/graphcut/doubt.h"
#include "stages/graphcut/energy.h"
#include "stages/graphcut/graphcut.h"

namespace roomcut::learn {
namespace {

constexpr double kWall = 4;  // a lost wall costs this many times its volume: it merges rooms
// [log-odds] No decision may stand on the edge, where nothing is in doubt either: what hangs on little here
// is wrong in the next building.
constexpr std::array kMargins{0.25, 1.0};
constexpr double kUnknown = 0.75;  // unknown is no room of the model, yet not denied
constexpr double kThin = 0.5;      // DataTerms::thin of what is a wall
constexpr double kHalf = 0.5;      // of a cell's volume: the truth's label
constexpr double kBeta = 1e-4;     // features are stored with seven digits

bool is_empty_in_truth(const LessonData& data, std::size_t cell) {
  return data.empty[cell] > kHalf * data.sampled[cell];
}

double probability(double log_odds) {
  return 1 / (1 + std::exp(-log_odds));
}

/// Whether a solid, thin cell has rooms on more than one side.
std::vector<std::uint8_t> walls_between(const LessonData& data) {
  std::vector<std::uint8_t> rooms(data.complex.cells(), 0);
  for_each_interface(data.complex, [&](const Interface& face) {
    for (const auto& [cell, other] : {std::pair(face.a, face.b), std::pair(face.b, face.a)}) {
      if (cell >= 0 && other >= 0) {
        const bool room = is_empty_in_truth(data, static_cast<std::size_t>(other));
        auto& count = rooms[static_cast<std::size_t>(cell)];
        count = static_cast<std::uint8_t>(std::min(2, count + (room ? 1 : 0)));
      }
    }
  });
  std::vector<std::uint8_t> between(data.complex.cells(), 0);
  for (std::size_t c = 0; c < between.size(); ++c) {
    between[c] = rooms[c] > 1 && data.terms.thin[c] > kThin && !is_empty_in_truth(data, c) ? 1 : 0;
  }
  return between;
}

}  // namespace

void read_files(const LessonFiles& files, LessonData& data) {
  CellsFile cells = read_cells(files.cells);
  data.weights = read_weights(files.weights, cells);
  data.terms = read_data_terms(files.terms, cells);
  const H5Reader truth = open_for_cells(files.truth, artefacts::kTruthCells, cells);
  data.sampled = truth.read<double>("cell/sampled", {cells.complex.cells()});
  data.empty = truth.read<double>("cell/empty", {cells.complex.cells()});
  data.complex = std::move(cells.complex);
}

Lesson::Lesson(LessonData data)
    : data_(std::move(data)),
      cut_(data_.complex, graphcut::energy_terms(data_.complex, data_.weights, data_.terms, data_.params)) {
  const std::size_t count = data_.complex.cells();
  const auto rows = static_cast<Eigen::Index>(count);
  const std::vector<CellFeature>& features = data_.terms.features;
  Eigen::VectorXd recorded(static_cast<Eigen::Index>(features.size() + 1));
  names_.emplace_back("constant");
  recorded[0] = data_.terms.constant;
  features_.resize(rows, recorded.size());
  features_.col(0).setOnes();
  for (std::size_t f = 0; f < features.size(); ++f) {
    const auto column = static_cast<Eigen::Index>(f + 1);
    names_.push_back(features[f].name);
    recorded[column] = features[f].weight;
    features_.col(column) = Eigen::Map<const Eigen::VectorXf>(features[f].value.data(), rows);
  }
  const Eigen::VectorXf odds = features_ * recorded.cast<float>();
  for (std::size_t c = 0; c < count; ++c) {
    const double volume = data_.complex.volume(c), beta = data_.terms.beta[c];
    if (std::abs(probability(odds[static_cast<Eigen::Index>(c)]) - beta) > kBeta) {
      throw std::invalid_argument(data_.scene + ": beta is not what its features and weights give");
    }
    // The volume's part of the data term is what is learned; own faces keep theirs.
    volume_.push_back(volume);
    own_empty_.push_back(std::max(0.0, data_.terms.d_empty[c] - volume * (1 - beta)));
    own_solid_.push_back(std::max(0.0, data_.terms.d_solid[c] - volume * beta));
    const double most = data_.params.unknown == "decided" ? 0 : data_.params.doubt;
    const graphcut::Doubt doubt = graphcut::doubt_of(data_.terms.seen_inside(c), data_.terms.closed[c], most);
    lower_.push_back(-doubt.invented);
    upper_.push_back(doubt.denied);
  }
  find_costs();
}

void Lesson::find_costs() {
  const std::vector<std::uint8_t> between = walls_between(data_);
  for (std::size_t c = 0; c < between.size(); ++c) {
    truth_m3_ += data_.empty[c];
    const double sure = std::abs(2 * data_.empty[c] - data_.sampled[c]);
    cost_.push_back((between[c] != 0 ? kWall : 1) * sure);
  }
}

std::vector<std::uint8_t> Lesson::cut_at(const Eigen::VectorXf& odds, const std::vector<double>& doubt,
                                         double margin) {
  std::vector<double> gain(volume_.size());
  for (std::size_t c = 0; c < gain.size(); ++c) {
    const double beta = probability(odds[static_cast<Eigen::Index>(c)] + doubt[c] + margin);
    gain[c] = graphcut::quantised(own_solid_[c] - own_empty_[c] + volume_[c] * (2 * beta - 1));
  }
  return cut_.label(gain);
}

double Lesson::loss(const Eigen::VectorXd& weights) {
  const Eigen::VectorXf odds = features_ * weights.cast<float>();
  double wrong = 0;
  for (const double margin : kMargins) {
    const std::vector<std::uint8_t> least = cut_at(odds, lower_, -margin),
                                    most = cut_at(odds, upper_, margin);
    for (std::size_t c = 0; c < least.size(); ++c) {
      const double solid = least[c] == most[c] ? (is_empty(least, c) ? 0 : 1) : kUnknown;
      wrong += cost_[c] * (is_empty_in_truth(data_, c) ? solid : 1 - solid);
    }
  }
  return wrong / (static_cast<double>(kMargins.size()) * truth_m3_);
}

double Lesson::iou(const Eigen::VectorXd& weights) const {
  const Eigen::VectorXf odds = features_ * weights.cast<float>();
  DataTerms terms = data_.terms;
  for (std::size_t c = 0; c < volume_.size(); ++c) {
    const double beta = probability(odds[static_cast<Eigen::Index>(c)]);
    terms.beta[c] = static_cast<float>(beta);
    terms.d_empty[c] = own_empty_[c] + volume_[c] * (1 - beta);
    terms.d_solid[c] = own_solid_[c] + volume_[c] * beta;
  }
  return iou_of(graphcut::graphcut(data_.complex, data_.weights, terms, data_.params).labels.label);
}

double Lesson::bound() const {
  std::vector<std::uint8_t> label(data_.complex.cells());
  for (std::size_t c = 0; c < label.size(); ++c) {
    label[c] = is_empty_in_truth(data_, c) ? Label::kEmpty : Label::kSolid;
  }
  return iou_of(label);
}

double Lesson::iou_of(const std::vector<std::uint8_t>& label) const {
  double common = 0;
  double both = truth_m3_;
  for (std::size_t c = 0; c < label.size(); ++c) {
    common += is_empty(label, c) ? data_.empty[c] : 0;
    both += is_empty(label, c) ? data_.sampled[c] - data_.empty[c] : 0;
  }
  return common / both;
}

}  // namespace roomcut::learn
