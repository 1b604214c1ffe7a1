// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

#include "common/cells/cell_complex.h"
#include "stages/graphcut/max_flow.h"
#include "stages/graphcut/params.h"

namespace roomcut::learn {

/// One pass of a scene of known truth.
struct LessonData {
  std::string scene, building;  ///< all scenes of a building are left out together
  bool made_up = false;         ///< a synthetic scene: must not become worse
  bool final = true;            ///< the pass that the model is made of
  CellComplex complex;
  FaceWeights weights;
  DataTerms terms;
  std::vector<double> sampled, empty;  ///< per cell: its volume, and what of it is empty in the truth [m^3]
  graphcut::GraphcutParams params;     ///< with which the scene was cut
};

/// Where its files lie.
struct LessonFiles {
  std::filesystem::path cells, weights, terms, truth;
};

/// Fills in what the files hold. Errors as in cells_io.h.
void read_files(const LessonFiles& files, LessonData& data);

/// What weights decide in one pass of a scene, and what a wrong decision costs. For one thread at a time.
class Lesson {
 public:
  /// Throws std::invalid_argument when beta in `data` is not what its features and weights give: there is
  /// nothing to learn then.
  explicit Lesson(LessonData data);

  const LessonData& data() const { return data_; }
  /// Names of the weights: "constant", then the features as data_terms.h5 has them.
  const std::vector<std::string>& names() const { return names_; }

  /// Whether any cell has the feature of this weight.
  bool has(Eigen::Index weight) const { return (features_.col(weight).array() != 0).any(); }

  /// What is wrong in the minimum cuts with the weights at the one and at the other end of graphcut's doubt
  /// and beyond, the mean over kMargins, as a share of the truth's volume: every cell by how sure the truth
  /// is of it, walls and slabs between rooms by kWall times their volume; what the cuts decide differently
  /// counts as solid to kUnknown. Cells without truth (ignored) count nowhere, rooms that nobody entered like
  /// all others. Deterministic.
  double loss(const Eigen::VectorXd& weights);
  /// Volume IoU with the truth of the labels that graphcut gives with these weights; unknown is no room.
  double iou(const Eigen::VectorXd& weights) const;
  /// The same of the truth's own label on every cell: what no weights can better.
  double bound() const;

 private:
  double iou_of(const std::vector<std::uint8_t>& label) const;
  void find_costs();
  std::vector<std::uint8_t> cut_at(const Eigen::VectorXf& odds, const std::vector<double>& doubt,
                                   double margin);

  LessonData data_;
  std::vector<std::string> names_;
  Eigen::MatrixXf features_;                            ///< cells x weights
  std::vector<double> volume_, own_empty_, own_solid_;  ///< what own faces say [m^3]
  std::vector<double> lower_, upper_;                   ///< ends of the doubt [log-odds]
  std::vector<double> cost_;
  graphcut::RepeatedCut cut_;
  double truth_m3_ = 0;
};

}  // namespace roomcut::learn
