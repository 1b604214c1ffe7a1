// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/detect_lines/detect_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <set>

#include "common/errors/codes.h"
#include "common/errors/error.h"
#include "common/geometry/preferred_number.h"
#include "common/wall_lines/wall_arc.h"
#include "stages/detect_lines/arcs.h"
#include "stages/detect_lines/column_lines.h"
#include "stages/detect_lines/free_cells.h"
#include "stages/detect_lines/jogs.h"
#include "stages/detect_lines/mean_shift.h"
#include "stages/detect_lines/merge_lines.h"

namespace roomcut::detect_lines {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kUnbounded_m = 1e9;

/// Everything that was derived from noise and extent.
struct Rules {
  FitRules fit;
  MergeRules merge;
  double angle_step = 0, distance_step = 0;
  Vec2 centre{0, 0};
  double radius_m = 0;
};

double resolve(const std::optional<double>& given, double derived, const char* name,
               std::vector<DetectLinesChoice>& choices) {
  if (given) return *given;
  choices.push_back({name, derived});
  return derived;
}

Rules derive_rules(const Slices& slices, const WallCells& cells, const DetectLinesParams& params,
                   std::vector<DetectLinesChoice>& choices) {
  Rules rules;
  const double noise = slices.noise_m;
  const double inlier = std::max(0.025, 2.5 * noise);
  rules.fit.inlier_m = resolve(params.inlier_m, inlier, "inlier_m", choices);
  rules.fit.inlier_angle_rad = params.inlier_angle_rad;
  rules.fit.cauchy_m = std::max(0.01, noise);
  rules.fit.bin_m = 2 * slices.tau_m;
  rules.fit.max_gap_m = params.max_gap_m;
  const double merge = std::clamp(3.5 * noise, 0.02, 0.06);
  rules.merge.distance_m = resolve(params.merge_m, merge, "merge_m", choices);
  rules.merge.angle_rad = params.merge_angle_rad;
  if (params.search == "mean_shift") {  // lines have no ends yet: only how similar they are counts
    rules.merge.minor_share = 0;
    rules.merge.reach_m = kUnbounded_m;
  }

  // The mean and preferred numbers: the accumulator does not move with the outermost cell.
  rules.centre = {std::accumulate(cells.x.begin(), cells.x.end(), 0.0),
                  std::accumulate(cells.y.begin(), cells.y.end(), 0.0)};
  rules.centre /= static_cast<double>(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    rules.radius_m =
        std::max(rules.radius_m, std::hypot(cells.x[i] - rules.centre.x(), cells.y[i] - rules.centre.y()));
  }
  // Two faces 8 cm apart must not blur into each other over the building's radius, which no turn changes.
  const double radius = preferred_number(std::max(1.0, rules.radius_m));
  const double angle = std::clamp(0.08 / (2 * radius) / kDegree, 0.1, 0.25);
  rules.radius_m = preferred_number_above(std::max(1.0, rules.radius_m));
  rules.angle_step = kDegree * resolve(params.hough_angle_deg, angle, "hough_angle_deg", choices);
  const double distance = std::clamp(preferred_number(noise), 0.01, 0.02);
  rules.distance_step = resolve(params.hough_distance_m, distance, "hough_distance_m", choices);
  return rules;
}

HoughPicture picture_of(const HoughAccumulator& votes, const Rules& rules) {
  constexpr std::size_t kAngles = 360, kDistances = 512;
  HoughPicture picture;
  const std::size_t per_angle = (votes.angles() + kAngles - 1) / kAngles;
  const std::size_t per_distance = (votes.distances() + kDistances - 1) / kDistances;
  picture.angles = (votes.angles() + per_angle - 1) / per_angle;
  picture.distances = (votes.distances() + per_distance - 1) / per_distance;
  picture.angle_step = static_cast<double>(per_angle) * votes.angle_step();
  picture.distance_step = static_cast<double>(per_distance) * votes.distance_step();
  picture.distance0 = votes.distance0();
  picture.centre = rules.centre;
  picture.votes_m.assign(picture.angles * picture.distances, 0);
  for (std::size_t a = 0; a < votes.angles(); ++a) {
    float* pixel = picture.votes_m.data() + a / per_angle * picture.distances;
    for (std::size_t d = 0; d < votes.distances(); d += per_distance, ++pixel) {
      const std::size_t end = std::min(d + per_distance, votes.distances());
      *pixel = std::max(*pixel, static_cast<float>(votes.highest_m(a, d, end)));
    }
  }
  return picture;
}

/// The lines that cells vote for: by the greedy search (highest peak, fit, take its cells' votes back), or
/// the modes of mean shift.
class LineSearch {
 public:
  LineSearch(WallCells& cells, const Rules& rules, const DetectLinesParams& params)
      : cells_(cells),
        rules_(rules),
        params_(params),
        votes_(rules.centre, rules.radius_m, rules.angle_step, rules.distance_step),
        free_(cells) {
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      if (cells.boundary[i] != 0) vote(i, +1);
    }
  }

  const HoughAccumulator& votes() const { return votes_; }

  /// What is explained already votes for no line.
  void leave_out(const CellIndices& explained) {
    CellIndices voters;
    std::copy_if(explained.begin(), explained.end(), std::back_inserter(voters),
                 [&](std::uint32_t i) { return cells_.boundary[i] != 0; });
    take_out(voters);
  }

  std::vector<LineCandidate> run() { return params_.search == "greedy" ? greedy() : modes(); }

 private:
  std::vector<LineCandidate> greedy() {
    std::vector<LineCandidate> found;
    for (;;) {
      const HoughAccumulator::Peak peak = votes_.peak();
      if (peak.votes_m < 0.5 * params_.min_support_m) return found;
      if (!take_line(peak.line, found)) votes_.suppress(peak);
    }
  }

  /// A line for each mode, as far as cells lie on it.
  std::vector<LineCandidate> modes() const {
    const Bandwidth bandwidth{0.5 * rules_.merge.angle_rad, 0.5 * rules_.merge.distance_m};
    std::vector<LineCandidate> found;
    for (const HoughMode& mode : hough_modes(votes_, bandwidth, params_.min_support_m)) {
      CellIndices on_line = free_.on_line(mode.line, rules_.fit, rules_.fit.inlier_m);
      if (on_line.empty()) continue;
      const auto along = [&](std::uint32_t i) { return mode.line.along({cells_.x[i], cells_.y[i]}); };
      const auto [first, last] = std::minmax_element(on_line.begin(), on_line.end(),
                                                     [&](auto i, auto j) { return along(i) < along(j); });
      const double t0 = along(*first);
      const double t1 = along(*last);
      if (t1 - t0 < params_.min_support_m) continue;
      found.push_back({mode.line, {t0, t1, mode.votes_m, std::move(on_line)}});
    }
    return found;
  }

  void vote(std::uint32_t i, int sign) {
    const bool equal = params_.votes == "equal";
    const auto theta = static_cast<double>(cells_.theta[i]);
    Vec2 p(cells_.x[i], cells_.y[i]);
    if (equal) p += static_cast<double>(cells_.offset_m[i]) * Line2{theta, 0}.normal();
    const double weight_m = equal ? 0.5 * rules_.fit.bin_m : static_cast<double>(cells_.weight_m[i]);
    votes_.vote(p, theta, params_.vote_window_rad, weight_m, sign);
  }

  void take_out(const CellIndices& taken) {
    for (const std::uint32_t i : taken) vote(i, -1);
    free_.take(taken);
  }

  /// The strongest support near `start` is fitted alone; other supports on the same line join it when they do
  /// not pull it. False when nothing lies there.
  bool take_line(const Line2& start, std::vector<LineCandidate>& found) {
    const double wide = rules_.fit.inlier_m + rules_.distance_step;
    const CellIndices near = free_.on_line(start, rules_.fit, wide);
    if (near.empty()) return false;
    const Support seed = supports(cells_, near, start, rules_.fit).front();
    const Line2 line = fit_line(cells_, seed.cells, start, rules_.fit);
    const CellIndices on_line = free_.on_line(line, rules_.fit, rules_.fit.inlier_m);
    if (on_line.empty()) return false;
    bool strongest = true;
    for (Support& support : supports(cells_, on_line, line, rules_.fit)) {
      const bool long_enough = support.support_m >= params_.min_support_m;
      if (!strongest && (!long_enough || !collinear(support, line))) continue;
      take_out(support.cells);
      if (long_enough) found.push_back({line, std::move(support)});
      strongest = false;
    }
    return true;
  }

  bool collinear(const Support& support, const Line2& line) const {
    const FitQuality fit = quality(cells_, support.cells, line);
    return std::abs(fit.mean_offset_m) <= std::max(0.005, 0.5 * rules_.fit.cauchy_m);
  }

  WallCells& cells_;
  const Rules& rules_;
  const DetectLinesParams& params_;
  HoughAccumulator votes_;
  FreeCells free_;
};

/// The lines of the cells that are not explained already; `picture`, if any, gets the votes of all.
std::vector<LineCandidate> search_lines(WallCells& cells, const CellIndices& explained, const Rules& rules,
                                        const DetectLinesParams& params, HoughPicture* picture) {
  LineSearch search(cells, rules, params);
  if (picture != nullptr) *picture = picture_of(search.votes(), rules);
  search.leave_out(explained);
  return search.run();
}

std::vector<double> heights_of(const Slices& slices) {
  std::vector<double> heights;
  for (std::size_t k = 0; k + 1 < slices.levels.size(); ++k) {
    heights.push_back(slices.levels[k + 1].z - slices.levels[k].z);
  }
  return heights;
}

OutlineRules column_fit(const Slices& slices) {
  return {slices.tau_m, std::max({0.03, 3 * slices.noise_m, 0.5 * slices.tau_m})};
}

/// Mean direction of the lines that go as most of the walls do, modulo 90 degrees; `main` to start with.
double direction_of(const std::vector<LineCandidate>& lines, double main) {
  double sum = 0, weight = 0;
  for (const LineCandidate& line : lines) {
    const double off = std::remainder(line.line.theta - main, std::numbers::pi / 2);
    const double length = line.support.support_m;
    if (std::abs(off) > 2 * kDegree) continue;
    sum += length * length * length * off;  // as its weight in a fit
    weight += length * length * length;
  }
  return weight > 0 ? main + sum / weight : main;
}

CellIndices cells_of_no_line(const WallCells& cells, const CellIndices& explained,
                             const std::vector<LineCandidate>& lines) {
  std::vector<bool> taken(cells.size(), false);
  for (const std::uint32_t i : explained) taken[i] = true;
  for (const LineCandidate& line : lines) {
    for (const std::uint32_t i : line.support.cells) taken[i] = true;
  }
  CellIndices free;
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    if (!taken[i]) free.push_back(i);
  }
  return free;
}

/// Adds the sides of columns, niches and pilasters to the lines; `explained` are the cells of columns and
/// arcs.
void add_short_lines(const Slices& slices, const WallCells& cells, const std::vector<Column>& columns,
                     const CellIndices& explained, const Rules& rules, std::vector<LineCandidate>& lines) {
  const double theta = direction_of(lines, main_direction(cells));
  std::vector<Side> sides = sides_of_columns(cells, columns, theta, column_fit(slices));
  const CellIndices free = cells_of_no_line(cells, explained, lines);
  const PieceRules pieces{slices.tau_m, slices.noise_m, rules.fit.inlier_m};
  for (Side& side : short_sides(cells, free, lines, pieces)) sides.push_back(std::move(side));
  const double aligned_m = std::max(0.004, 0.6 * slices.noise_m);
  for (LineCandidate& line : align_sides(std::move(sides), aligned_m)) lines.push_back(std::move(line));
}

WallLine to_wall_line(const LineCandidate& candidate, const WallCells& cells, std::size_t index) {
  const std::string number = std::to_string(index + 1);
  const FitQuality fit = quality(cells, candidate.support.cells, candidate.line);
  WallLine wall;
  wall.id = "w" + std::string(4 - std::min<std::size_t>(4, number.size()), '0') + number;
  if (!candidate.column.empty()) wall.extra_json = "{\"column\":\"" + candidate.column + "\"}";
  wall.a = candidate.line.at(candidate.support.t0);
  wall.b = candidate.line.at(candidate.support.t1);
  wall.support_m = candidate.support.support_m;
  wall.rms_m = fit.rms_m;
  wall.sigma_offset_m = fit.sigma_offset_m;
  wall.sigma_angle_rad = fit.sigma_angle_rad;
  return wall;
}

WallArc wall_arc(const Arc& arc, int index) {
  const std::string number = std::to_string(index + 1);
  return {"a" + std::string(4 - std::min<std::size_t>(4, number.size()), '0') + number, arc.centre,
          arc.radius_m};
}

/// The wall slices of a line that was seen in slices at a roof's steps only: there it is a contour of the
/// roof, below it stands no wall. Empty for other lines.
std::optional<std::vector<int>> roof_slices(const LineCandidate& candidate, const WallCells& cells,
                                            const std::vector<Level>& levels) {
  std::set<int> slices;
  for (const std::uint32_t cell : candidate.support.cells) slices.insert(cells.slice[cell]);
  const bool roof = std::all_of(slices.begin(), slices.end(), [&](int k) {
    const auto lower = static_cast<std::size_t>(k);
    return levels[lower].step || levels[lower + 1].step;
  });
  if (!roof) return std::nullopt;
  return std::vector<int>(slices.begin(), slices.end());
}

[[noreturn]] void no_lines(const WallCells& cells, const DetectLinesParams& params) {
  const auto boundary = std::count(cells.boundary.begin(), cells.boundary.end(), std::uint8_t{1});
  char text[200];
  std::snprintf(text, sizeof text,
                "no wall line: %zu occupied cells, %td of them linear, none of them in a row of %.2f m",
                cells.size(), boundary, params.min_support_m);
  throw StageError(
      errors::kNoWallLines, "detect_lines", text,
      "walls must be upright; for a very sparse scan raise slice.tau_m or lower detect_lines.min_support_m");
}

}  // namespace

DetectLinesResult detect_lines(const Slices& slices, const DetectLinesParams& params) {
  DetectLinesResult result;
  result.cells = classify_cells(slices, params.linearity, params.wider);
  WallCells& cells = result.cells;
  if (cells.size() == 0) no_lines(cells, params);
  const Rules rules = derive_rules(slices, cells, params, result.choices);
  std::vector<Column> columns;
  if (params.short_lines) {
    columns = find_columns(cells, {slices.noise_m, heights_of(slices), column_fit(slices)});
  }
  CellIndices explained;
  for (const Column& column : columns) {
    explained.insert(explained.end(), column.cells.begin(), column.cells.end());
  }
  std::vector<LineCandidate> found = search_lines(cells, explained, rules, params, &result.hough);
  std::vector<Arc> arcs;
  if (params.arcs) arcs = find_arcs(cells, found, explained, {slices.tau_m, slices.noise_m});
  if (!arcs.empty()) {  // the lines of all else
    for (const Arc& arc : arcs) explained.insert(explained.end(), arc.cells.begin(), arc.cells.end());
    found = search_lines(cells, explained, rules, params, nullptr);
  }
  const std::size_t before = found.size();
  found = merge_near_duplicates(cells, std::move(found), rules.merge, rules.fit);
  result.merged = before - found.size();
  result.arcs = arcs.size();
  if (found.empty() && arcs.empty()) no_lines(cells, params);
  if (params.short_lines) add_short_lines(slices, cells, columns, explained, rules, found);
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    for (LineCandidate& chord : chords_of(cells, arcs[k], slices.noise_m)) {
      chord.arc = static_cast<int>(k);
      found.push_back(std::move(chord));
    }
  }

  result.lines.frame = slices.frame;
  result.lines.bbox_min = slices.bbox_min.head<2>();
  result.lines.bbox_max = slices.bbox_max.head<2>();
  for (std::size_t i = 0; i < found.size(); ++i) {
    result.lines.lines.push_back(to_wall_line(found[i], cells, i));
    if (const int arc = found[i].arc; arc >= 0) {
      set_arc(result.lines.lines.back(), wall_arc(arcs[static_cast<std::size_t>(arc)], arc), slices.frame);
    }
    result.lines.lines.back().levels = roof_slices(found[i], cells, slices.levels);
    for (const std::uint32_t cell : found[i].support.cells) {
      if (cells.line[cell] < 0) cells.line[cell] = static_cast<std::int32_t>(i);
    }
  }
  return result;
}

}  // namespace roomcut::detect_lines
