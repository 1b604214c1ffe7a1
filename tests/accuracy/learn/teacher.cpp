// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/accuracy/learn/teacher.h"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace roomcut::learn {
namespace {

constexpr double kPull = 1e-3;  // cost of weights one scale away from the prior
constexpr double kMadeUp = 1;   // what a loss of synthetic scenes counts …
constexpr double kWorse = 2;    // … and what goes beyond the loss of the weights that raycast has

/// How much of each weight is one step of the search.
Eigen::VectorXd scale_of(const Eigen::VectorXd& prior) {
  return Eigen::VectorXd::Ones(prior.size()) + 0.3 * prior.cwiseAbs();
}

/// The weights with the signs of the prior: what of a few buildings speaks against physics is chance.
Eigen::VectorXd within_signs(const Eigen::VectorXd& weights, const Eigen::VectorXd& prior) {
  Eigen::VectorXd within = weights;
  for (Eigen::Index i = 1; i < within.size(); ++i) {
    within[i] = within[i] * prior[i] < 0 ? 0 : within[i];
  }
  return within;
}

/// What weights cost on the lessons of some buildings.
class Teacher {
 public:
  Teacher(const School& school, const std::string& left_out)
      : prior_(school.prior), scale_(scale_of(prior_)) {
    for (Lesson& lesson : school.lessons) {
      if (lesson.data().building != left_out) {
        chosen_.push_back(&lesson);
      }
    }
    if (chosen_.empty()) {
      throw std::invalid_argument("no lesson is left to learn from");
    }
    share_lessons();
    shipped_ = losses({school.shipped}).front();
  }

  /// Whether any lesson has something to say of this weight.
  bool knows(Eigen::Index weight) const {
    return std::any_of(chosen_.begin(), chosen_.end(),
                       [&](const Lesson* lesson) { return lesson->has(weight); });
  }

  std::vector<double> costs(const std::vector<Eigen::VectorXd>& candidates) {
    std::vector<double> cost;
    for (const std::vector<double>& loss : losses(candidates)) {
      cost.push_back(kPull * (candidates[cost.size()] - prior_).cwiseQuotient(scale_).squaredNorm() /
                     prior_.size());
      for (std::size_t i = 0; i < chosen_.size(); ++i) {
        const double worse = kWorse * std::max(0.0, loss[i] - shipped_[i]);
        cost.back() += share_[i] * (chosen_[i]->data().made_up ? kMadeUp * loss[i] + worse : loss[i]);
      }
    }
    return cost;
  }

 private:
  /// Real buildings together count one, and made-up ones; each building of a kind the same.
  void share_lessons() {
    std::map<bool, std::map<std::string, double>> lessons;  // of the real, of the made-up buildings
    for (const Lesson* lesson : chosen_) {
      ++lessons[lesson->data().made_up][lesson->data().building];
    }
    // The longest first, so that no thread is left with one at the end.
    std::stable_sort(chosen_.begin(), chosen_.end(), [](const Lesson* a, const Lesson* b) {
      return a->data().complex.cells() > b->data().complex.cells();
    });
    for (const Lesson* lesson : chosen_) {
      const auto& alike = lessons[lesson->data().made_up];
      share_.push_back(1 / (static_cast<double>(alike.size()) * alike.at(lesson->data().building)));
    }
  }

  /// Per candidate and lesson. Each lesson goes through all candidates, for its cut goes on from the last.
  std::vector<std::vector<double>> losses(const std::vector<Eigen::VectorXd>& candidates) {
    std::vector<std::vector<double>> loss(candidates.size(), std::vector<double>(chosen_.size()));
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, chosen_.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            for (std::size_t c = 0; c < candidates.size(); ++c) {
              loss[c][i] = chosen_[i]->loss(candidates[c]);
            }
          }
        },
        tbb::simple_partitioner());
    return loss;
  }

  std::vector<Lesson*> chosen_;
  std::vector<double> share_;    ///< what each counts
  std::vector<double> shipped_;  ///< losses of the weights that raycast has
  Eigen::VectorXd prior_, scale_;
};

}  // namespace

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

Evolved learned_weights(const School& school, const std::string& left_out, const EvolutionParams& params) {
  Teacher teacher(school, left_out);
  Eigen::VectorXd scale = scale_of(school.prior);
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    scale[i] = teacher.knows(i) ? scale[i] : 0;
  }
  Evolved found = evolve(
      [&](std::vector<Eigen::VectorXd> candidates) {
        for (Eigen::VectorXd& candidate : candidates) {
          candidate = within_signs(candidate, school.prior);
        }
        return teacher.costs(candidates);
      },
      school.prior, scale, params);
  found.best = within_signs(found.best, school.prior);
  return found;
}

}  // namespace roomcut::learn
