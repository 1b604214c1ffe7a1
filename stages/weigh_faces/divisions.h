// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace roomcut::weigh_faces {

/// An axis cut at given breaks (the ends of edges, the levels), every interval between two breaks divided
/// into equal bins of about the wanted length. Bins belong to one interval only, and a margin at both ends of
/// every interval belongs to none (at most a fifth of a short interval): what lies beyond a break never
/// counts for this side.
class Divisions {
 public:
  Divisions() = default;
  /// `breaks` ascending and different. Fewer than two: no bins.
  Divisions(const std::vector<double>& breaks, double bin, double margin);

  int bins() const { return static_cast<int>(low_.size()); }
  double low(int bin) const { return low_[static_cast<std::size_t>(bin)]; }
  double high(int bin) const { return high_[static_cast<std::size_t>(bin)]; }
  double length(int bin) const { return high(bin) - low(bin); }
  /// The bin that holds x, or -1.
  int find(double x) const;
  /// First bin of the interval that holds x, and one past its last. Empty range outside the breaks.
  struct Range {
    int begin, end;
  };
  Range interval_of(double x) const;

 private:
  std::vector<double> breaks_;
  std::vector<int> first_;          // bins of interval i: [first_[i], first_[i + 1])
  std::vector<double> low_, high_;  // of the bins
  double step_ = 1, per_step_ = 1;
  std::vector<std::int32_t> hint_;  // per step: the first bin that ends beyond its start
};

}  // namespace roomcut::weigh_faces
