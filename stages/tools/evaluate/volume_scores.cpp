// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/evaluate/volume_scores.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "common/random/counter_random.h"

namespace roomcut::evaluate {

namespace {

// Lengths instead of volumes; one per row of the grid.
struct Sums {
  double truth = 0, model = 0, common = 0;
  std::vector<double> room, room_empty;
};

class ColumnComparison {
 public:
  ColumnComparison(const Columns& truth, const Columns& model, const std::vector<TruthRoom>& rooms,
                   const RoomFinder& finder)
      : truth_(truth), model_(model), rooms_(rooms), finder_(finder) {
    for (const TruthRoom& room : rooms) {
      any_body_ = any_body_ || room.body >= 0;
    }
  }

  void add(double x, double y, Sums& sums) {
    truth_.crossings(x, y, truth_crossings_);
    model_.crossings(x, y, model_crossings_);
    enclosed(truth_crossings_, -1, truth_parts_);
    enclosed(model_crossings_, -1, model_parts_);
    sums.truth += total_length(truth_parts_);
    sums.model += total_length(model_parts_);
    sums.common += overlap(truth_parts_, model_parts_);
    finder_.prisms_at(x, y, prisms_);
    for (const std::int32_t i : prisms_) {
      const TruthRoom& room = rooms_[static_cast<std::size_t>(i)];
      room_parts_.assign(1, {room.floor, room.ceiling});
      add_room(i, sums);
    }
    if (any_body_) {
      add_bodies(sums);
    }
  }

 private:
  void add_bodies(Sums& sums) {
    bodies_.clear();
    for (const Crossing& crossing : truth_crossings_) {
      if (std::find(bodies_.begin(), bodies_.end(), crossing.component) == bodies_.end()) {
        bodies_.push_back(crossing.component);
      }
    }
    for (const std::int32_t body : bodies_) {
      const std::int32_t room = finder_.of_body(body);
      if (room >= 0) {
        enclosed(truth_crossings_, body, room_parts_);
        add_room(room, sums);
      }
    }
  }

  void add_room(std::int32_t room, Sums& sums) {
    sums.room[static_cast<std::size_t>(room)] += total_length(room_parts_);
    sums.room_empty[static_cast<std::size_t>(room)] += overlap(room_parts_, model_parts_);
  }

  const Columns& truth_;
  const Columns& model_;
  const std::vector<TruthRoom>& rooms_;
  const RoomFinder& finder_;
  bool any_body_ = false;
  std::vector<Crossing> truth_crossings_, model_crossings_;
  std::vector<Interval> truth_parts_, model_parts_, room_parts_;
  std::vector<std::int32_t> prisms_, bodies_;
};

}  // namespace

VolumeScores compare_volumes(const Columns& truth, const Columns& model, const std::vector<TruthRoom>& rooms,
                             const RoomFinder& finder, const Vec2& lo, const Vec2& hi, double spacing_m,
                             std::uint64_t seed) {
  const auto nx = static_cast<std::int64_t>((hi.x() - lo.x()) / spacing_m) + 1;
  const auto ny = static_cast<std::int64_t>((hi.y() - lo.y()) / spacing_m) + 1;
  std::vector<Sums> rows(static_cast<std::size_t>(ny));
  tbb::parallel_for(std::int64_t{0}, ny, [&](std::int64_t iy) {
    ColumnComparison comparison(truth, model, rooms, finder);
    Sums& sums = rows[static_cast<std::size_t>(iy)];
    sums.room.assign(rooms.size(), 0);
    sums.room_empty.assign(rooms.size(), 0);
    for (std::int64_t ix = 0; ix < nx; ++ix) {
      const auto counter = static_cast<std::uint64_t>(2 * ix);
      const double jx = random_unit(seed, static_cast<std::uint64_t>(iy), counter);
      const double jy = random_unit(seed, static_cast<std::uint64_t>(iy), counter + 1);
      comparison.add(lo.x() + (static_cast<double>(ix) + jx) * spacing_m,
                     lo.y() + (static_cast<double>(iy) + jy) * spacing_m, sums);
    }
  });
  VolumeScores out;
  out.room_m3.assign(rooms.size(), 0);
  out.room_empty_m3.assign(rooms.size(), 0);
  const double area = spacing_m * spacing_m;
  for (const Sums& sums : rows) {
    out.truth_m3 += area * sums.truth;
    out.model_m3 += area * sums.model;
    out.common_m3 += area * sums.common;
    for (std::size_t i = 0; i < rooms.size(); ++i) {
      out.room_m3[i] += area * sums.room[i];
      out.room_empty_m3[i] += area * sums.room_empty[i];
    }
  }
  return out;
}

}  // namespace roomcut::evaluate
