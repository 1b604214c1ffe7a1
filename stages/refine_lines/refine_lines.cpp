// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/refine_lines.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "common/errors/codes.h"
#include "common/wall_lines/wall_arc.h"
#include "stages/refine_lines/adjust.h"
#include "stages/refine_lines/arc_fit.h"
#include "stages/refine_lines/line_faces.h"
#include "stages/refine_lines/line_item.h"
#include "stages/refine_lines/merge_lines.h"
#include "stages/refine_lines/new_lines.h"
#include "stages/refine_lines/observe.h"

namespace roomcut::refine_lines {

namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr std::size_t kFewestObservations = 3;
constexpr LinePrior kUsersPrior{0.02, 1.0 * kDeg};
constexpr double kLoosePrior_rad = 0.5 * kDeg;  ///< detection is better than that
constexpr int kMergeRounds = 5;
constexpr double kShareOfShort = 0.5;  ///< of what a line can carry: the side of a niche of 8 cm is small

bool is_users(const WallLine& line) {
  return line.locked || line.source == LineSource::kEdited || line.source == LineSource::kAdded;
}

}  // namespace

struct LineRefiner::State {
  const CellComplex& complex;
  RefineLinesParams params;
  double band, merge, apart;
  WallLines kept;                   ///< frame, box, base; no lines
  std::set<std::string> one_sided;  ///< ids of the lines that came with such walls
  std::vector<WallLine> walls;      ///< survivors, sorted by id
  std::vector<std::size_t> index;   ///< of each survivor among complex.lines, or that list's size
  std::vector<LineFaces> faces;     ///< of complex.lines
  std::unique_ptr<LineObserver> observer;
  Refinement result;

  void solve_each(std::vector<LineItem>& items) const;
  void solve_together(std::vector<LineItem>& items);
  bool merge_near(std::vector<LineItem>& items);
  /// Refines the chords of one arc and adds them to the result, their shifts to `shifts`.
  void add_arc(std::vector<LineItem>& chords, std::vector<double>& shifts);
  LinePrior prior_of(const LineItem& item) const {
    return item.users && params.edited_lines == "prior" ? kUsersPrior : LinePrior{band, kLoosePrior_rad};
  }
  bool is_held(const LineItem& item) const {
    return item.wall.locked || (item.users && params.edited_lines == "locked") ||
           item.observations.size() < kFewestObservations;
  }
};

LineRefiner::LineRefiner(const WallLines& lines, const CellComplex& complex,
                         const std::vector<std::uint8_t>& label, double noise_m, double density,
                         const RefineLinesParams& params, std::vector<OneSidedWall> one_sided,
                         const CarriedRuns& carried)
    : state_(new State{complex,
                       params,
                       params.band_m.value_or(std::max(0.06, 5 * noise_m)),
                       params.merge_m.value_or(std::max(0.015, 1.2 * noise_m)),
                       params.split_m.value_or(std::max(0.005, 0.5 * noise_m)),
                       lines,
                       {},
                       {},
                       {},
                       {},
                       nullptr,
                       {}}) {
  State& s = *state_;
  s.kept.lines.clear();
  s.faces = find_line_faces(complex, label, params.bin_m, carried);
  s.one_sided = ids_of(one_sided);
  s.result.one_sided = std::move(one_sided);
  std::map<std::string, std::size_t> by_id;
  for (std::size_t i = 0; i < complex.lines.size(); ++i) {
    by_id.emplace(complex.lines[i].wall_id, i);
  }
  const auto area_of = [&](const WallLine& wall) {
    const auto found = by_id.find(wall.id);
    return found == by_id.end() ? 0.0 : s.faces[found->second].area_m2;
  };
  std::map<std::string, double> arc_area;  // the chords of an arc stay together
  for (const WallLine& wall : lines.lines) {
    if (const auto arc = arc_of(wall, lines.frame)) {
      arc_area[arc->id] += area_of(wall);
    }
  }
  std::vector<bool> active(complex.lines.size(), false);
  bool any_surface = false;
  double tallest = 0;
  for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
    tallest = std::max(tallest, complex.height(layer));
  }
  for (const WallLine& wall : lines.lines) {
    const auto found = by_id.find(wall.id);
    const std::size_t i = found == by_id.end() ? complex.lines.size() : found->second;
    const auto arc = arc_of(wall, lines.frame);
    const double area = arc ? arc_area.at(arc->id) : area_of(wall);
    any_surface = any_surface || area > 0;
    const double enough = std::min(params.min_interface_m2, kShareOfShort * wall.length() * tallest);
    if (area < enough && !is_users(wall) && !s.one_sided.contains(wall.id)) {
      ++s.result.dropped;
      continue;
    }
    s.walls.push_back(wall);
    s.index.push_back(i);
    if (i < complex.lines.size()) {
      active[i] = true;
    }
  }
  if (!any_surface) {
    throw StageError(errors::kNoWallLines, "refine_lines",
                     "no wall line separates empty from solid space in the first cut",
                     "look at the labels of graphcut: is every cell solid?");
  }
  s.observer = std::make_unique<LineObserver>(s.faces, active, complex.levels, s.band, noise_m, density);
}

LineRefiner::~LineRefiner() = default;
double LineRefiner::band_m() const {
  return state_->band;
}
double LineRefiner::split_m() const {
  return state_->apart;
}
double LineRefiner::merge_m() const {
  return state_->merge;
}
void LineRefiner::add(const CloudTile& tile) {
  state_->observer->add(tile);
}

void LineRefiner::State::solve_each(std::vector<LineItem>& items) const {
  tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) {
    LineItem& item = items[i];
    if (item.stale) {
      item.constant = is_held(item);
      item.problem = make_problem(item.wall.line(), item.wall.centre(), item.observations, prior_of(item));
      item.alone = fit_line(item.problem);
      if (item.constant) {
        item.alone.pose = unmoved(item.problem);
      }
      item.stale = false;
    }
    item.fit = item.alone;
  });
}

void LineRefiner::State::solve_together(std::vector<LineItem>& items) {
  Adjustment adjustment;
  std::vector<Direction> directions;
  for (const LineItem& item : items) {
    adjustment.lines.push_back(item.problem);
    adjustment.constant.push_back(item.constant);
    adjustment.poses.push_back(item.fit.pose);
    directions.push_back({item.wall.id, item.problem.line.theta + item.fit.pose.turn,
                          std::sqrt(item.fit.covariance.turn_turn), !item.constant});
  }
  adjustment.regularity_rad = params.regularity_rad;
  adjustment.classes = find_angle_classes(directions);
  result.classes = static_cast<int>(adjustment.classes.angle.size());
  result.converged = adjust(adjustment);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const bool parallel = adjustment.classes.class_of[i] >= 0;
    items[i].fit.pose = adjustment.poses[i];
    items[i].fit.covariance =
        pose_covariance(items[i].problem, adjustment.poses[i], parallel ? params.regularity_rad : 0.0);
  }
}

bool LineRefiner::State::merge_near(std::vector<LineItem>& items) {
  std::vector<MergeCandidate> candidates;
  std::vector<std::size_t> of_item;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const LineItem& item = items[i];
    if (!item.faces.empty() && item.faces.front().bins > 0) {
      candidates.push_back({posed(item.problem.line, item.problem.centre, item.fit.pose), item.problem.centre,
                            std::sqrt(item.fit.covariance.shift_shift), &item.faces.front(), item.users,
                            item.area_m2, item.wall.id});
      of_item.push_back(i);
    }
  }
  const std::vector<std::size_t> into = find_merges(candidates, merge, params.merge_angle_rad);
  std::vector<bool> gone(items.size(), false);
  for (std::size_t k = 0; k < into.size(); ++k) {
    if (into[k] == k) {
      continue;
    }
    LineItem& weak = items[of_item[k]];
    LineItem& strong = items[of_item[into[k]]];
    strong.observations.insert(strong.observations.end(), weak.observations.begin(), weak.observations.end());
    strong.faces.insert(strong.faces.end(), weak.faces.begin(), weak.faces.end());
    strong.area_m2 += weak.area_m2;
    strong.stale = true;
    if (!weak.wall.levels || !strong.wall.levels) {
      strong.wall.levels.reset();
    } else {
      strong.wall.levels->insert(strong.wall.levels->end(), weak.wall.levels->begin(),
                                 weak.wall.levels->end());
      std::sort(strong.wall.levels->begin(), strong.wall.levels->end());
      strong.wall.levels->erase(std::unique(strong.wall.levels->begin(), strong.wall.levels->end()),
                                strong.wall.levels->end());
    }
    const Line2 line = strong.wall.line();
    const auto place = [&](const Observation& o) { return std::pair(o.zone, line.along(o.point)); };
    std::stable_sort(strong.observations.begin(), strong.observations.end(),
                     [&](const Observation& a, const Observation& b) { return place(a) < place(b); });
    gone[of_item[k]] = true;
    ++result.merged;
  }
  std::vector<LineItem> left;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!gone[i]) {
      left.push_back(std::move(items[i]));
    }
  }
  const bool merged_any = left.size() < items.size();
  items = std::move(left);
  return merged_any;
}

void LineRefiner::State::add_arc(std::vector<LineItem>& chords, std::vector<double>& shifts) {
  double prior_m = band;
  for (LineItem& chord : chords) {
    chord.constant = chord.wall.locked || (chord.users && params.edited_lines == "locked");
    prior_m = std::min(prior_m, prior_of(chord).shift_m);
    result.observations += static_cast<int>(chord.observations.size());
    result.held += chord.constant ? 1 : 0;
  }
  const std::vector<WallLine> refined_chords = refine_arc(chords, kept.frame, prior_m);
  for (std::size_t k = 0; k < refined_chords.size(); ++k) {
    if (!chords[k].constant) {
      shifts.push_back(std::abs(refined_chords[k].line().distance(chords[k].wall.centre())));
    }
    result.lines.lines.push_back(refined_chords[k]);
  }
}

Refinement LineRefiner::finish() {
  State& s = *state_;
  std::vector<LineItem> items;
  for (std::size_t i = 0; i < s.walls.size(); ++i) {
    LineItem item;
    item.wall = s.walls[i];
    item.users = is_users(item.wall);
    item.keeps_ends = item.users || s.one_sided.contains(item.wall.id);
    if (s.index[i] < s.faces.size()) {
      item.faces.push_back(s.faces[s.index[i]]);
      item.area_m2 = item.faces.front().area_m2;
    }
    items.push_back(std::move(item));
  }
  tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) {
    if (s.index[i] < s.faces.size()) {
      items[i].observations = s.observer->observations(s.index[i]);
    }
  });
  s.result.points = s.observer->points();
  std::map<std::string, std::vector<LineItem>> arcs = take_arcs(items, s.kept.frame);
  s.result.split = split_items(
      s.complex, s.apart, [&](const LineItem& item) { return s.prior_of(item); }, s.result.one_sided, items);
  s.result.bends = split_at_hinges(s.complex, items);
  s.solve_each(items);
  s.result.bends += add_bends(s.complex, items);
  s.solve_each(items);
  s.solve_together(items);
  for (int round = 0; round < kMergeRounds && s.merge_near(items); ++round) {
    s.solve_each(items);
    s.solve_together(items);
  }
  std::vector<double> shifts;
  s.result.lines = s.kept;
  for (const LineItem& item : items) {
    s.result.lines.lines.push_back(refined(item));
    s.result.observations += static_cast<int>(item.observations.size());
    s.result.held += item.constant ? 1 : 0;
    if (!item.constant) {
      shifts.push_back(std::abs(s.result.lines.lines.back().line().distance(item.wall.centre())));
    }
  }
  for (auto& [id, chords] : arcs) {
    s.add_arc(chords, shifts);
  }
  s.result.arcs = static_cast<int>(arcs.size());
  s.result.refined = static_cast<int>(shifts.size());
  if (!shifts.empty()) {
    std::sort(shifts.begin(), shifts.end());
    s.result.median_shift_m = shifts[shifts.size() / 2];
    s.result.largest_shift_m = shifts.back();
  }
  return s.result;
}

}  // namespace roomcut::refine_lines
