// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/graphcut/energy.h"

namespace roomcut::learn {

/// Where the files of one pass of a scene lie, and what they are an example of.
struct LessonFiles {
  std::string building;  ///< left out together
  bool made_up = false;  ///< a synthetic scene: must not become worse
  std::filesystem::path cells, weights, terms, truth;
};

/// One pass of a scene of known truth: what the weights decide there, and what a wrong decision costs.
class Lesson {
 public:
  /// Errors as in cells_io.h.
  explicit Lesson(const LessonFiles& files);

  const std::string& building() const { return building_; }
  bool made_up() const { return made_up_; }
  /// Names of the weights: "constant", then the features as data_terms.h5 has them.
  const std::vector<std::string>& names() const { return names_; }

  /// What is wrong in the minimum cut with these weights, as a share of the truth's volume: every cell by
  /// how sure the truth is of it, walls between rooms by kWall times their volume. Deterministic.
  double loss(const Eigen::VectorXd& weights) const;
  /// Volume IoU of the same labels with the truth.
  double iou(const Eigen::VectorXd& weights) const;

 private:
  std::vector<std::uint8_t> labels(const Eigen::VectorXd& weights) const;

  std::string building_;
  bool made_up_;
  std::vector<std::string> names_;
  CellComplex complex_;
  graphcut::EnergyTerms faces_;  ///< their d_empty, d_solid: what own faces say
  Eigen::MatrixXf features_;     ///< cells x weights
  std::vector<double> sampled_, truth_, cost_;
  double truth_m3_ = 0;
};

}  // namespace roomcut::learn
