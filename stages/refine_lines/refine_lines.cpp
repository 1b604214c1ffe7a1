// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/refine_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "common/errors/codes.h"
#include "stages/refine_lines/adjust.h"
#include "stages/refine_lines/bends.h"
#include "stages/refine_lines/line_faces.h"
#include "stages/refine_lines/merge_lines.h"
#include "stages/refine_lines/observe.h"
#include "stages/refine_lines/split_lines.h"

namespace roomcut {

namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr std::size_t kFewestObservations = 3;
constexpr LinePrior kUsersPrior{0.02, 1.0 * kDeg};
constexpr double kLoosePrior_rad = 0.5 * kDeg;  ///< detection is better than that
constexpr int kMergeRounds = 5;

bool is_users(const WallLine& line) {
  return line.locked || line.source == LineSource::kEdited || line.source == LineSource::kAdded;
}

/// A surviving line on its way through the refinement.
struct Item {
  WallLine wall;
  std::vector<LineFaces> faces;  ///< one entry; of a merged line those of all that went into it
  std::vector<Observation> observations;
  LineProblem problem;
  LineFit fit;
  bool constant = false;
  bool users = false;
  bool keeps_ends = false;  ///< of a line of the user's, or a wall seen from one side
  double area_m2 = 0;
};

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

  void split(std::vector<Item>& items);
  void add_bends(std::vector<Item>& items);
  void solve_each(std::vector<Item>& items) const;
  void solve_together(std::vector<Item>& items);
  bool merge_near(std::vector<Item>& items);
  LinePrior prior_of(const Item& item) const {
    return item.users && params.edited_lines == "prior" ? kUsersPrior : LinePrior{band, kLoosePrior_rad};
  }
  bool is_held(const Item& item) const {
    return item.wall.locked || (item.users && params.edited_lines == "locked") ||
           item.observations.size() < kFewestObservations;
  }
};

LineRefiner::LineRefiner(const WallLines& lines, const CellComplex& complex,
                         const std::vector<std::uint8_t>& label, double noise_m, double density,
                         const RefineLinesParams& params, std::vector<OneSidedWall> one_sided)
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
  s.faces = find_line_faces(complex, label, params.bin_m);
  s.one_sided = ids_of(one_sided);
  s.result.one_sided = std::move(one_sided);
  std::map<std::string, std::size_t> by_id;
  for (std::size_t i = 0; i < complex.lines.size(); ++i) {
    by_id.emplace(complex.lines[i].wall_id, i);
  }
  std::vector<bool> active(complex.lines.size(), false);
  bool any_surface = false;
  for (const WallLine& wall : lines.lines) {
    const auto found = by_id.find(wall.id);
    const std::size_t i = found == by_id.end() ? complex.lines.size() : found->second;
    const double area = i < complex.lines.size() ? s.faces[i].area_m2 : 0;
    any_surface = any_surface || area > 0;
    if (area < params.min_interface_m2 && !is_users(wall) && !s.one_sided.contains(wall.id)) {
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

/// Lines of the user's stay whole: they said what is one wall.
void LineRefiner::State::split(std::vector<Item>& items) {
  std::vector<double> heights;
  std::set<std::string> ids;
  for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
    heights.push_back(complex.height(layer));
  }
  for (const Item& item : items) {
    ids.insert(item.wall.id);
  }
  const std::size_t whole = items.size();
  for (std::size_t i = 0; i < whole; ++i) {
    if (items[i].users || items[i].faces.empty()) {
      continue;
    }
    std::vector<LinePart> parts =
        split_line(items[i].faces.front(), items[i].observations, heights, prior_of(items[i]), apart);
    if (parts.size() == 1) {
      continue;
    }
    const std::string id = items[i].wall.id;
    std::vector<std::vector<OneSidedWall*>> one_sided_of(parts.size());
    for (OneSidedWall& wall : result.one_sided) {
      if (wall.wall_id == id) {
        const auto nearest = std::min_element(
            parts.begin(), parts.end(),
            [&](const LinePart& a, const LinePart& b) { return steps_to(a, wall) < steps_to(b, wall); });
        one_sided_of[static_cast<std::size_t>(nearest - parts.begin())].push_back(&wall);
      }
    }
    for (std::size_t k = parts.size(); k-- > 0;) {
      Item part = items[i];
      part.area_m2 = parts[k].faces.area_m2;
      part.wall.levels = levels_of(parts[k], items[i].wall.levels);
      part.faces = {std::move(parts[k].faces)};
      part.observations = std::move(parts[k].observations);
      for (int number = 1; k > 0 && !ids.insert(part.wall.id).second; ++number) {
        part.wall.id = id + "." + std::to_string(number);
      }
      part.keeps_ends = !one_sided_of[k].empty();
      for (OneSidedWall* wall : one_sided_of[k]) {
        wall->wall_id = part.wall.id;
      }
      if (k == 0) {
        items[i] = std::move(part);
        break;
      }
      ++result.split;
      items.push_back(std::move(part));
    }
  }
}

void LineRefiner::State::add_bends(std::vector<Item>& items) {
  std::vector<double> heights;
  std::vector<FittedLine> lines;
  std::vector<std::size_t> of_line;
  std::set<std::string> ids;
  for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
    heights.push_back(complex.height(layer));
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Item& item = items[i];
    ids.insert(item.wall.id);
    if (!item.faces.empty() && item.faces.front().bins > 0) {
      lines.push_back({posed(item.problem.line, item.problem.centre, item.fit.pose), &item.faces.front(),
                       &item.observations});
      of_line.push_back(i);
    }
  }
  std::vector<Item> added;
  for (Bend& bend : find_bends(lines, heights)) {
    Item item = items[of_line[bend.parent]];
    const std::string id = item.wall.id;
    for (int number = 1; !ids.insert(item.wall.id).second; ++number) {
      item.wall.id = id + "." + std::to_string(number);
    }
    item.wall.a = bend.faces.line.at(bend.faces.t0);
    item.wall.b = bend.faces.line.at(bend.faces.t1);
    item.users = item.keeps_ends = false;
    item.wall.locked = false;
    item.wall.source = LineSource::kRefined;
    item.area_m2 = bend.faces.area_m2;
    item.faces = {std::move(bend.faces)};
    item.observations = std::move(bend.observations);
    added.push_back(std::move(item));
  }
  result.bends = static_cast<int>(added.size());
  items.insert(items.end(), std::make_move_iterator(added.begin()), std::make_move_iterator(added.end()));
}

void LineRefiner::State::solve_each(std::vector<Item>& items) const {
  for (Item& item : items) {
    item.constant = is_held(item);
    item.problem = make_problem(item.wall.line(), item.wall.centre(), item.observations, prior_of(item));
    item.fit = fit_line(item.problem);
    if (item.constant) {
      item.fit.pose = unmoved(item.problem);
    }
  }
}

void LineRefiner::State::solve_together(std::vector<Item>& items) {
  Adjustment adjustment;
  std::vector<Direction> directions;
  for (const Item& item : items) {
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

bool LineRefiner::State::merge_near(std::vector<Item>& items) {
  std::vector<MergeCandidate> candidates;
  std::vector<std::size_t> of_item;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Item& item = items[i];
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
    Item& weak = items[of_item[k]];
    Item& strong = items[of_item[into[k]]];
    strong.observations.insert(strong.observations.end(), weak.observations.begin(), weak.observations.end());
    strong.faces.insert(strong.faces.end(), weak.faces.begin(), weak.faces.end());
    strong.area_m2 += weak.area_m2;
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
  std::vector<Item> left;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!gone[i]) {
      left.push_back(std::move(items[i]));
    }
  }
  const bool merged_any = left.size() < items.size();
  items = std::move(left);
  return merged_any;
}

namespace {

/// The interval that the line must have in the second pass: everywhere it carries surface; a user's line also
/// where drawn.
void set_ends(WallLine& wall, const Item& item, const Line2& line) {
  std::vector<Vec2> places;
  for (const LineFaces& faces : item.faces) {
    places.push_back(faces.line.at(faces.t0));
    places.push_back(faces.line.at(faces.t1));
  }
  if (item.keeps_ends) {
    places.push_back(wall.a);
    places.push_back(wall.b);
  }
  double low = line.along(places.front());
  double high = low;
  for (const Vec2& place : places) {
    low = std::min(low, line.along(place));
    high = std::max(high, line.along(place));
  }
  wall.a = line.at(low);
  wall.b = line.at(high);
}

/// Length of the bins along the line that have at least one observation [m].
double covered_length(const Item& item, const Line2& line) {
  const double bin = item.faces.empty() ? 1 : item.faces.front().bin_m;
  std::set<long> bins;
  for (const Observation& o : item.observations) {
    bins.insert(std::lround(std::floor(line.along(o.point) / bin)));
  }
  return bin * static_cast<double>(bins.size());
}

void set_measures(WallLine& wall, const Item& item, const Line2& line) {
  double squares = 0;
  double points = 0;
  for (const Observation& o : item.observations) {
    const double distance = line.distance(o.point);
    squares += o.points * (o.scatter_m2 + distance * distance);
    points += o.points;
  }
  wall.rms_m = points > 0 ? std::sqrt(squares / points) : 0;
  wall.support_m = std::min(wall.length(), covered_length(item, line));
  // A turn moves the support's centre by its distance from the centroid that the line turns about.
  const double arm = line.direction().dot(wall.centre() - item.problem.centre);
  const PoseCovariance& c = item.fit.covariance;
  wall.sigma_offset_m =
      std::sqrt(std::max(0.0, c.shift_shift - 2 * arm * c.turn_shift + arm * arm * c.turn_turn));
  wall.sigma_angle_rad = std::sqrt(c.turn_turn);
}

WallLine refined(const Item& item) {
  WallLine wall = item.wall;
  if (item.constant) {
    return wall;
  }
  const Line2 line = posed(item.problem.line, item.problem.centre, item.fit.pose);
  set_ends(wall, item, line);
  set_measures(wall, item, line);
  wall.source = LineSource::kRefined;
  return wall;
}

}  // namespace

Refinement LineRefiner::finish() {
  State& s = *state_;
  std::vector<Item> items;
  for (std::size_t i = 0; i < s.walls.size(); ++i) {
    Item item;
    item.wall = s.walls[i];
    item.users = is_users(item.wall);
    item.keeps_ends = item.users || s.one_sided.contains(item.wall.id);
    if (s.index[i] < s.faces.size()) {
      item.faces.push_back(s.faces[s.index[i]]);
      item.area_m2 = item.faces.front().area_m2;
      item.observations = s.observer->observations(s.index[i]);
    }
    items.push_back(std::move(item));
  }
  s.result.points = s.observer->points();
  s.split(items);
  s.solve_each(items);
  s.add_bends(items);
  s.solve_each(items);
  s.solve_together(items);
  for (int round = 0; round < kMergeRounds && s.merge_near(items); ++round) {
    s.solve_each(items);
    s.solve_together(items);
  }
  std::vector<double> shifts;
  s.result.lines = s.kept;
  for (const Item& item : items) {
    s.result.lines.lines.push_back(refined(item));
    s.result.observations += static_cast<int>(item.observations.size());
    s.result.held += item.constant ? 1 : 0;
    if (!item.constant) {
      shifts.push_back(std::abs(s.result.lines.lines.back().line().distance(item.wall.centre())));
    }
  }
  s.result.refined = static_cast<int>(shifts.size());
  if (!shifts.empty()) {
    std::sort(shifts.begin(), shifts.end());
    s.result.median_shift_m = shifts[shifts.size() / 2];
    s.result.largest_shift_m = shifts.back();
  }
  return s.result;
}

}  // namespace roomcut
