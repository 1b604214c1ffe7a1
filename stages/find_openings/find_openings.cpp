// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/find_openings/find_openings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <tuple>

namespace roomcut::find_openings {

namespace {

constexpr double kAboveFloor_m = 0.1;  // skirtings, thresholds and the floor itself lie below
constexpr double kClear_m = 0.06;      // evidence of openness keeps this far from jambs and head …
constexpr double kNear_m = 0.12;       // … and is asked for by itself this far beside a jamb
constexpr double kBelowHead_m = 0.25;  // and below the head
constexpr double kBeside_m = 0.2;      // the wall beside a jamb is looked at as far as this
constexpr double kJambDepth_m = 0.02;
constexpr double kLintel_m = 0.25;  // a lower lintel shows too few rows
constexpr double kMostCovered = 0.2, kMostFilled = 0.125;
constexpr double kMostNear = 0.35;  // of a narrow strip
constexpr double kWallGoesOn = 0.4;

class WallSearch {
 public:
  WallSearch(const RoomWall& wall, const Reveal& reveal, const std::vector<double>& levels,
             const FindOpeningsParams& params, const OpeningTolerances& tolerances)
      : wall_(wall), reveal_(reveal), levels_(levels), params_(params), tolerances_(tolerances) {}

  std::vector<Opening> search() {
    for (const Stretch& stretch : stretches()) {
      search(stretch);
    }
    return std::move(found_);
  }

 private:
  std::vector<Stretch> stretches() const;
  void search(const Stretch& stretch);
  std::optional<Opening> check(const Stretch& stretch, const RevealSurface& a, const RevealSurface& b) const;
  bool is_open(double t0, double t1, double z0, double z1) const;
  bool wall_goes_on(const Stretch& stretch, double t0, double t1, double z0, double z1) const;
  bool head_fits(const Stretch& stretch, double t0, double t1, double head) const;
  bool has_gap(const Stretch& stretch, double t0, double t1) const;
  Opening make(const Stretch& stretch, const RevealSurface& a, const RevealSurface& b,
               const RevealSurface& head) const;
  double door_z0(const Stretch& stretch) const { return stretch.floor_z + kAboveFloor_m; }
  double door_z1(const Stretch& stretch) const { return stretch.floor_z + params_.min_height_m; }

  const RoomWall& wall_;
  const Reveal& reveal_;
  const std::vector<double>& levels_;
  const FindOpeningsParams& params_;
  const OpeningTolerances& tolerances_;
  std::vector<Opening> found_;
};

/// Neighbouring columns whose wall stands on one level, high enough for an opening.
std::vector<Stretch> WallSearch::stretches() const {
  std::vector<Stretch> done;
  for (std::size_t bottom = 0; bottom < wall_.layers; ++bottom) {
    Stretch open;
    const auto close = [&](std::size_t column) {
      if (static_cast<double>(column - open.first) * wall_.step_m > params_.min_width_m) {
        open.last = column;
        done.push_back(open);
      }
      open.first = column + 1;
    };
    for (std::size_t c = 0; c < wall_.columns; ++c) {
      std::size_t top = bottom;
      while (top < wall_.layers && wall_.stands(c, top)) {
        ++top;
      }
      const bool starts_here = top > bottom && (bottom == 0 || !wall_.stands(c, bottom - 1));
      if (!starts_here || levels_[top] - levels_[bottom] < params_.min_height_m) {
        close(c);
        continue;
      }
      open.floor_z = levels_[bottom];
      open.top_z = c == open.first ? levels_[top] : std::min(open.top_z, levels_[top]);
    }
    close(wall_.columns);
  }
  return done;
}

/// Whether both faces are uncovered and nothing is between them from jamb to jamb, and also close to each
/// jamb.
bool WallSearch::is_open(double t0, double t1, double z0, double z1) const {
  const auto all = reveal_.cover(t0 + kClear_m, t1 - kClear_m, z0, z1);
  if (!all || all->either() > kMostCovered || all->inside > kMostFilled) {
    return false;
  }
  for (const double t : {t0 + kClear_m, t1 - kClear_m - kNear_m}) {
    const auto strip = reveal_.cover(t, t + kNear_m, z0, z1);
    if (!strip || strip->either() > kMostNear || strip->inside > kMostNear) {
      return false;
    }
  }
  return true;
}

/// Whether a face of the wall is covered between t0 and t1, as far as the stretch goes.
bool WallSearch::wall_goes_on(const Stretch& stretch, double t0, double t1, double z0, double z1) const {
  const double first = wall_.t0() + static_cast<double>(stretch.first) * wall_.step_m;
  const double last = wall_.t0() + static_cast<double>(stretch.last) * wall_.step_m;
  const auto cover = reveal_.cover(std::max(t0, first), std::min(t1, last), z0, z1);
  return cover && cover->either() >= kWallGoesOn;
}

/// Whether it is open right below the head and a face is covered above it, where the lintel is high enough to
/// tell.
bool WallSearch::head_fits(const Stretch& stretch, double t0, double t1, double head) const {
  const double clear = std::max(0.03, 2.5 * tolerances_.noise_m);
  const auto below = reveal_.cover(t0 + kClear_m, t1 - kClear_m, head - clear - kBelowHead_m, head - clear);
  if (below && below->either() > kMostNear) {
    return false;
  }
  const auto above = reveal_.cover(t0, t1, head + kJambDepth_m, stretch.top_z - kJambDepth_m);
  if (stretch.top_z - head < kLintel_m || !above) {
    return !has_gap(stretch, t0, t1);  // without a lintel it may as well be where two walls end
  }
  return above->either() >= kWallGoesOn;
}

/// Whether the cut has left the wall away somewhere between t0 and t1.
bool WallSearch::has_gap(const Stretch& stretch, double t0, double t1) const {
  const auto layer = static_cast<std::size_t>(
      std::lower_bound(levels_.begin(), levels_.end(), stretch.floor_z) - levels_.begin());
  for (std::size_t c = stretch.first; c < stretch.last; ++c) {
    const double t = wall_.t0() + (static_cast<double>(c) + 0.5) * wall_.step_m;
    if (t > t0 && t < t1 && wall_.is_gap(c, layer)) {
      return true;
    }
  }
  return false;
}

std::optional<Opening> WallSearch::check(const Stretch& stretch, const RevealSurface& a,
                                         const RevealSurface& b) const {
  const double width = b.at - a.at;
  const double z0 = door_z0(stretch);
  const double z1 = door_z1(stretch);
  if (width < params_.min_width_m || width > params_.max_width_m || !is_open(a.at, b.at, z0, z1) ||
      !wall_goes_on(stretch, a.at - kBeside_m, a.at - kJambDepth_m, z0, z1) ||
      !wall_goes_on(stretch, b.at + kJambDepth_m, b.at + kBeside_m, z0, z1)) {
    return std::nullopt;
  }
  const auto head =
      reveal_.find_head(a.at + kClear_m, b.at - kClear_m, z1, stretch.top_z + tolerances_.window_m());
  if (!head || !head_fits(stretch, a.at, b.at, head->at)) {
    return std::nullopt;
  }
  return make(stretch, a, b, *head);
}

Opening WallSearch::make(const Stretch& stretch, const RevealSurface& a, const RevealSurface& b,
                         const RevealSurface& head) const {
  const auto middle_of_wall = [&](double t) -> Vec2 {
    return wall_.a.at(t) + 0.5 * wall_.side * wall_.thickness(t) * wall_.a.normal();
  };
  Opening opening;
  opening.jamb_a = middle_of_wall(a.at);
  opening.jamb_b = middle_of_wall(b.at);
  opening.thickness_m = wall_.thickness(0.5 * (a.at + b.at));
  opening.sill_z = stretch.floor_z;
  // An opening up to the ceiling ends at it: a lintel of no height can't be told from noise.
  opening.head_z = stretch.top_z - head.at < tolerances_.window_m() ? stretch.top_z : head.at;
  opening.proof_a = a.proof;
  opening.proof_b = b.proof;
  opening.proof_head = head.proof;
  return opening;
}

/// All pairs of jambs that pass, best proven first, as far as they don't overlap.
void WallSearch::search(const Stretch& stretch) {
  const std::vector<RevealSurface> jambs = reveal_.find_jambs(stretch, door_z0(stretch), door_z1(stretch));
  struct Candidate {
    double t0, t1;
    Opening opening;
    std::uint64_t points() const { return std::uint64_t{opening.proof_a.points} + opening.proof_b.points; }
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < jambs.size(); ++i) {
    for (std::size_t k = i + 1; k < jambs.size() && jambs[k].at - jambs[i].at <= params_.max_width_m; ++k) {
      if (auto opening = check(stretch, jambs[i], jambs[k])) {
        candidates.push_back({jambs[i].at, jambs[k].at, *opening});
      }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.points() > b.points(); });
  std::vector<Candidate> taken;
  for (const Candidate& candidate : candidates) {
    const bool free = std::none_of(taken.begin(), taken.end(), [&](const Candidate& other) {
      return candidate.t0 < other.t1 + kClear_m && other.t0 < candidate.t1 + kClear_m;
    });
    if (free) {
      taken.push_back(candidate);
      found_.push_back(candidate.opening);
    }
  }
}

}  // namespace

OpeningTolerances opening_tolerances(const FindOpeningsParams& params, double noise_m, double density) {
  OpeningTolerances result;
  result.noise_m = noise_m;
  result.margin_m = params.margin_m.value_or(std::max(0.015, 3 * noise_m));
  result.row_m = std::clamp(3 / (0.15 * std::max(density, 1.0)), 0.1, 0.5);
  return result;
}

std::vector<Opening> find_openings_in(const RoomWall& wall, const WallRasters& rasters,
                                      const std::vector<double>& levels, const FindOpeningsParams& params,
                                      const OpeningTolerances& tolerances) {
  const Reveal reveal(wall, rasters, tolerances);
  return WallSearch(wall, reveal, levels, params, tolerances).search();
}

void join_heads(std::vector<Opening>& openings, const std::vector<double>& levels) {
  constexpr double kSame_m = 0.004;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < openings.size(); ++i) {
    if (!std::binary_search(levels.begin(), levels.end(), openings[i].head_z)) {  // else it ends at a ceiling
      order.push_back(i);
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return openings[a].head_z < openings[b].head_z; });
  const auto flush = [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    double weight = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Opening& opening = openings[order[i]];
      sum += opening.proof_head.points * opening.head_z;
      weight += opening.proof_head.points;
    }
    for (std::size_t i = begin; i < end; ++i) {
      openings[order[i]].head_z = sum / weight;
    }
  };
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= order.size(); ++i) {
    const bool ends = i == order.size() || [&] {
      const Opening& low = openings[order[begin]];
      const Opening& here = openings[order[i]];
      return here.head_z - low.head_z >
             std::max(kSame_m, 3 * std::hypot(low.proof_head.sigma_m, here.proof_head.sigma_m));
    }();
    if (ends && begin < i) {
      flush(begin, i);
      begin = i;
    }
  }
}

std::vector<Opening> find_openings(const CellComplex& complex, const std::vector<RoomWall>& walls,
                                   const WallEvidence& evidence, const FindOpeningsParams& params,
                                   const OpeningTolerances& tolerances) {
  std::vector<Opening> all;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (Opening& opening :
         find_openings_in(walls[i], evidence.rasters(i), complex.levels, params, tolerances)) {
      opening.wall_a = complex.lines[static_cast<std::size_t>(walls[i].line_a)].wall_id;
      opening.wall_b = complex.lines[static_cast<std::size_t>(walls[i].line_b)].wall_id;
      all.push_back(std::move(opening));
    }
  }
  join_heads(all, complex.levels);
  std::sort(all.begin(), all.end(), [](const Opening& a, const Opening& b) {
    const auto key = [](const Opening& o) {
      return std::tuple(o.sill_z, o.jamb_a.x() + o.jamb_b.x(), o.jamb_a.y() + o.jamb_b.y());
    };
    return key(a) < key(b);
  });
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::array<char, 32> id;
    std::snprintf(id.data(), id.size(), "o%04zu", i + 1);
    all[i].id = id.data();
  }
  return all;
}

}  // namespace roomcut::find_openings
