// SPDX-License-Identifier: GPL-3.0-or-later
// usage: learn_weights LESSONS PRIOR [BUILDING [GENERATIONS]]: learns the weights of the data term with the
// cut in the loop. LESSONS: JSON, what `make accuracy-weights` writes; PRIOR: a weights.table where the
// search starts and is drawn to; BUILDING: left out. Prints JSON: the weights, and the IoU of every lesson
// with them, with the prior and with those that raycast had.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>

#include "common/artefact/atomic_file.h"
#include "common/artefact/json_values.h"
#include "stages/raycast/features.h"
#include "tests/accuracy/learn/evolution.h"
#include "tests/accuracy/learn/lesson.h"

namespace {

using namespace roomcut;
using namespace roomcut::learn;

constexpr double kOffset = 0.25;  // [log-odds] no decision may stand on the edge: the constant off by this
constexpr double kPull = 2e-4;    // cost of weights one scale away from the prior
constexpr double kMadeUp = 0.3;   // what a loss of synthetic scenes counts …
constexpr double kWorse = 2;      // … and what goes beyond the loss of the weights that raycast has

double loss_around(const Lesson& lesson, Eigen::VectorXd weights) {
  weights[0] -= kOffset;
  double loss = lesson.loss(weights);
  weights[0] += 2 * kOffset;
  return (loss + lesson.loss(weights)) / 2;
}

/// The features of the lessons in their order, and what the table says of each.
Eigen::VectorXd in_order(const raycast::FeatureWeights& table, const std::vector<std::string>& names) {
  Eigen::VectorXd weights(static_cast<Eigen::Index>(names.size()));
  weights[0] = table.constant;
  for (std::size_t i = 1; i < names.size(); ++i) {
    const auto found = std::find_if(table.features.begin(), table.features.end(),
                                    [&](const raycast::FeatureWeight& f) { return f.name == names[i]; });
    if (found == table.features.end()) {
      throw std::invalid_argument("the lessons have a feature that the table lacks: " + names[i]);
    }
    weights[static_cast<Eigen::Index>(i)] = found->weight;
  }
  return weights;
}

std::vector<Lesson> read_lessons(const std::filesystem::path& path) {
  std::vector<LessonFiles> files;
  for (const Json& item : parse_json(read_text_file(path))) {
    files.push_back({item.at("building"), item.at("made_up"), std::string(item.at("cells")),
                     std::string(item.at("weights")), std::string(item.at("terms")),
                     std::string(item.at("truth"))});
  }
  std::vector<std::unique_ptr<Lesson>> read(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(),
                    [&](std::size_t i) { read[i] = std::make_unique<Lesson>(files[i]); });
  std::vector<Lesson> lessons;
  for (std::unique_ptr<Lesson>& lesson : read) {
    lessons.push_back(std::move(*lesson));
  }
  return lessons;
}

/// What weights cost: the mean loss of the real buildings, each counting once however many lessons it has,
/// and of made-up scenes above all what becomes worse.
class Teacher {
 public:
  Teacher(const std::vector<Lesson>& lessons, const std::string& left_out, const Eigen::VectorXd& shipped,
          Eigen::VectorXd prior, Eigen::VectorXd scale)
      : prior_(std::move(prior)), scale_(std::move(scale)) {
    for (const Lesson& lesson : lessons) {
      if (lesson.building() != left_out) chosen_.push_back(&lesson);
    }
    shipped_.resize(chosen_.size());
    tbb::parallel_for(std::size_t{0}, chosen_.size(),
                      [&](std::size_t i) { shipped_[i] = loss_around(*chosen_[i], shipped); });
  }
  std::vector<double> costs(const std::vector<Eigen::VectorXd>& candidates) const {
    std::vector<double> loss(candidates.size() * chosen_.size());
    tbb::parallel_for(std::size_t{0}, loss.size(), [&](std::size_t i) {
      loss[i] = loss_around(*chosen_[i % chosen_.size()], candidates[i / chosen_.size()]);
    });
    std::vector<double> cost;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      cost.push_back(cost_of(candidates[c], loss.data() + c * chosen_.size()));
    }
    return cost;
  }

 private:
  double cost_of(const Eigen::VectorXd& candidate, const double* loss) const {
    double real = 0, made_up = 0, reals = 0, made_ups = 0;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      if (chosen_[i]->made_up()) {
        made_up += kMadeUp * loss[i] + kWorse * std::max(0.0, loss[i] - shipped_[i]);
        ++made_ups;
      } else {
        real += loss[i];
        ++reals;
      }
    }
    const double away = (candidate - prior_).cwiseQuotient(scale_).squaredNorm() / prior_.size();
    return real / std::max(1.0, reals) + made_up / std::max(1.0, made_ups) + kPull * away;
  }

  std::vector<const Lesson*> chosen_;
  std::vector<double> shipped_;  ///< losses of the weights that raycast has
  Eigen::VectorXd prior_, scale_;
};

int run(int argc, char** argv) {
  const std::vector<Lesson> lessons = read_lessons(argv[1]);
  const std::vector<std::string>& names = lessons.at(0).names();
  const Eigen::VectorXd prior = in_order(raycast::parse_weights(read_text_file(argv[2])), names);
  const Eigen::VectorXd shipped = in_order(raycast::shipped_weights(), names);
  const Eigen::VectorXd scale = Eigen::VectorXd::Ones(prior.size()) + 0.3 * prior.cwiseAbs();
  const Teacher teacher(lessons, argc > 3 ? argv[3] : "", shipped, prior, scale);
  EvolutionParams params;
  if (argc > 4) params.generations = std::stoi(argv[4]);
  const auto costs = [&](const std::vector<Eigen::VectorXd>& candidates) {
    return teacher.costs(candidates);
  };
  const Evolved found = evolve(costs, prior, scale, params);
  Json result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    result["weights"][names[i]] = std::round(100 * found.best[static_cast<Eigen::Index>(i)]) / 100;
  }
  result["cost"] = found.cost;
  for (const Lesson& lesson : lessons) {
    result["lessons"].push_back({{"building", lesson.building()},
                                 {"prior", lesson.iou(prior)},
                                 {"shipped", lesson.iou(shipped)},
                                 {"learned", lesson.iou(found.best)}});
  }
  std::cout << pretty_json(result) << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 5) {
    std::cerr << "usage: learn_weights LESSONS PRIOR [BUILDING [GENERATIONS]]\n";
    return 2;
  }
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "learn_weights: " << error.what() << "\n";
    return 3;
  }
}
