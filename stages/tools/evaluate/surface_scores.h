// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "common/mesh/mesh_tree.h"
#include "stages/tools/evaluate/samples.h"

namespace roomcut::evaluate {

/// A surface by its slope: within 10 degrees of upright, within 25 degrees of level, or neither.
enum class SlopeClass : std::uint8_t { kWall = 0, kHorizontal = 1, kSloped = 2 };
SlopeClass slope_class(const Vec3& unit_normal);

/// Distances from one surface to another [m], means weighted by area.
struct Deviation {
  double max = 0;  ///< one-sided Hausdorff distance, of the samples
  double mean = 0, rms = 0, p95 = 0;
};

/// How closely a surface is met: within 1 degree and 5 mm, or 2 cm; within 1.5 degrees and 4 cm, as well as
/// the scans of phones and depth cameras allow; or not.
enum class Match : std::uint8_t { kNone = 0, kLoose = 1, kClose = 2, kFine = 3 };

/// One surface against another, sample by sample.
struct SurfaceDistances {
  std::vector<SurfaceSample> samples;
  std::vector<SlopeClass> slope;  ///< of each sample's triangle
  std::vector<double> distance;   ///< to the other surface
  std::vector<double>
      class_distance;  ///< to the other surface's triangles of the same slope class; infinite beyond 10 cm
  /// How closely a triangle of the other surface that faces the same way follows.
  std::vector<Match> match;
  Deviation deviation;
};

/// A mesh prepared to be measured against.
class MeasuredSurface {
 public:
  explicit MeasuredSurface(const TriangleMesh& mesh);
  const MeshTree& all() const { return all_; }
  const MeshTree& of(SlopeClass slope) const { return classes_[static_cast<std::size_t>(slope)]; }

 private:
  MeshTree all_;
  std::array<MeshTree, 3> classes_;
};

/// Measures `from` against `to`; samples for which `counts` is false are left out when they are farther from
/// `to` than the largest buffer. Parallel; the same result for any number of threads.
SurfaceDistances measure(
    const TriangleMesh& from, const MeasuredSurface& from_surface, const MeasuredSurface& to,
    double spacing_m, std::uint64_t seed,
    const std::function<bool(const Vec3&)>& counts = [](const Vec3&) { return true; });

/// Completeness, correctness and accuracy of the ISPRS benchmark on indoor modelling (Khoshelham et al. 2017,
/// 2021), per slope class: share of the reference's area within `buffer` of the model, share of the model's
/// area within `buffer` of the reference, median distance of the reference's samples that are within
/// `buffer`. Empty where there is no area.
struct IsprsScore {
  std::optional<double> completeness, correctness, accuracy_m;
};
IsprsScore isprs_score(const SurfaceDistances& truth, const SurfaceDistances& model, SlopeClass slope,
                       double buffer_m);

/// Share of the area of one slope class of `truth` (walls or horizontals) that a model surface of that class
/// follows at least so closely; empty without such area.
std::optional<double> matched_share(const SurfaceDistances& truth, SlopeClass slope,
                                    Match least = Match::kClose);

}  // namespace roomcut::evaluate
