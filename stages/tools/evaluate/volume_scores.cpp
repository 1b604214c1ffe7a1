// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/volume_scores.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "common/random/counter_random.h"

namespace roomcut::evaluate {

namespace {

void add(ComparedVolumes& sums, const std::vector<Interval>& truth, const std::vector<Interval>& model) {
  sums.truth_m3 += total_length(truth);
  sums.model_m3 += total_length(model);
  sums.common_m3 += overlap(truth, model);
}

void add(ComparedVolumes& sums, const ComparedVolumes& row, double area) {
  sums.truth_m3 += area * row.truth_m3;
  sums.model_m3 += area * row.model_m3;
  sums.common_m3 += area * row.common_m3;
}

void add(std::vector<double>& sums, const std::vector<double>& row, double area) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] += area * row[i];
  }
}

VolumeScores zero(std::size_t rooms) {
  VolumeScores out;
  out.room_m3.assign(rooms, 0);
  out.room_empty_m3.assign(rooms, 0);
  out.room_unknown_m3.assign(rooms, 0);
  return out;
}

/// Sums lengths instead of volumes, over one row of the grid.
class ColumnComparison {
 public:
  explicit ColumnComparison(const VolumeInput& input) : input_(input), sums_(zero(input.rooms.size())) {
    for (const TruthRoom& room : input.rooms) {
      any_body_ = any_body_ || room.body >= 0;
    }
  }

  void add_column(double x, double y) {
    find_parts(x, y);
    add(sums_, truth_parts_, model_parts_);
    sums_.unknown_m3 += total_length(unknown_parts_);
    sums_.unknown_in_truth_m3 += overlap(unknown_parts_, truth_parts_);
    unentered_.clear();
    input_.finder.prisms_at(x, y, prisms_);
    for (const std::int32_t i : prisms_) {
      const TruthRoom& room = input_.rooms[static_cast<std::size_t>(i)];
      clip(truth_parts_, room.floor, room.ceiling, room_parts_);  // less than the prism under a slope
      add_room(i);
    }
    if (any_body_) {
      add_bodies();
    }
    unite(unentered_);
    subtract(truth_parts_, unentered_, seen_truth_);
    subtract(model_parts_, unentered_, seen_model_);
    add(sums_.seen, seen_truth_, seen_model_);
  }

  VolumeScores& sums() { return sums_; }

 private:
  void find_parts(double x, double y) {
    input_.truth.crossings(x, y, truth_crossings_);
    input_.model.crossings(x, y, crossings_);
    enclosed(truth_crossings_, -1, truth_parts_);
    enclosed(crossings_, -1, all_parts_);
    input_.ignored.at(x, y, truth_parts_, ignored_parts_);
    sums_.ignored_m3 += overlap(all_parts_, ignored_parts_);
    subtract(all_parts_, ignored_parts_, model_parts_);
    unknown_parts_.clear();
    if (input_.unknown != nullptr) {
      input_.unknown->at(x, y, all_parts_);
      subtract(all_parts_, ignored_parts_, unknown_parts_);
    }
  }

  void add_bodies() {
    bodies_.clear();
    for (const Crossing& crossing : truth_crossings_) {
      if (std::find(bodies_.begin(), bodies_.end(), crossing.component) == bodies_.end()) {
        bodies_.push_back(crossing.component);
      }
    }
    for (const std::int32_t body : bodies_) {
      const std::int32_t room = input_.finder.of_body(body);
      if (room >= 0) {
        enclosed(truth_crossings_, body, room_parts_);
        add_room(room);
      }
    }
  }

  void add_room(std::int32_t index) {
    const auto room = static_cast<std::size_t>(index);
    sums_.room_m3[room] += total_length(room_parts_);
    sums_.room_empty_m3[room] += overlap(room_parts_, model_parts_);
    sums_.room_unknown_m3[room] += overlap(room_parts_, unknown_parts_);
    if (!input_.rooms[room].scanned) {
      unentered_.insert(unentered_.end(), room_parts_.begin(), room_parts_.end());
    }
  }

  const VolumeInput& input_;
  VolumeScores sums_;
  bool any_body_ = false;
  std::vector<Crossing> truth_crossings_, crossings_;
  std::vector<Interval> truth_parts_, all_parts_, model_parts_, ignored_parts_, unknown_parts_, room_parts_;
  std::vector<Interval> unentered_, seen_truth_, seen_model_;
  std::vector<std::int32_t> prisms_, bodies_;
};

}  // namespace

VolumeScores compare_volumes(const VolumeInput& input, const Vec2& lo, const Vec2& hi, double spacing_m,
                             std::uint64_t seed) {
  const auto nx = static_cast<std::int64_t>((hi.x() - lo.x()) / spacing_m) + 1;
  const auto ny = static_cast<std::int64_t>((hi.y() - lo.y()) / spacing_m) + 1;
  std::vector<VolumeScores> rows(static_cast<std::size_t>(ny));
  tbb::parallel_for(std::int64_t{0}, ny, [&](std::int64_t iy) {
    ColumnComparison comparison(input);
    for (std::int64_t ix = 0; ix < nx; ++ix) {
      const auto counter = static_cast<std::uint64_t>(2 * ix);
      const double jx = random_unit(seed, static_cast<std::uint64_t>(iy), counter);
      const double jy = random_unit(seed, static_cast<std::uint64_t>(iy), counter + 1);
      comparison.add_column(lo.x() + (static_cast<double>(ix) + jx) * spacing_m,
                            lo.y() + (static_cast<double>(iy) + jy) * spacing_m);
    }
    rows[static_cast<std::size_t>(iy)] = std::move(comparison.sums());
  });
  VolumeScores out = zero(input.rooms.size());
  const double area = spacing_m * spacing_m;
  for (const VolumeScores& row : rows) {
    add(out, row, area);
    add(out.seen, row.seen, area);
    out.ignored_m3 += area * row.ignored_m3;
    out.unknown_m3 += area * row.unknown_m3;
    out.unknown_in_truth_m3 += area * row.unknown_in_truth_m3;
    add(out.room_m3, row.room_m3, area);
    add(out.room_empty_m3, row.room_empty_m3, area);
    add(out.room_unknown_m3, row.room_unknown_m3, area);
  }
  return out;
}

}  // namespace roomcut::evaluate
