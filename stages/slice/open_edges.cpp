// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/open_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "common/cloud/cloud.h"
#include "stages/slice/fixed_point.h"
#include "stages/slice/surface_graph.h"

namespace roomcut::slice {
namespace {

constexpr double kShortest_m = 3.5;    // shorter ones are mostly where a scan of a room ends
constexpr double kSmallest_m2 = 4;     // of a ceiling
constexpr double kHeadroom_m = 1.5;    // from the floor to the ceiling
constexpr double kUnderCeiling_m = 1;  // where a wall would be seen
constexpr double kOverCeiling_m = 0.5;
constexpr double kWallShare = 0.5;  // of that height that upright surface covers: there is a wall
constexpr double kLargestGap_m = 0.6;
constexpr double kDense = 0.6;   // of a stretch's border cells are open
constexpr double kInside_m = 1;  // depth of the ceiling that says how much area a metre has
constexpr int kAngles = 180;

/// A border cell of a ceiling beyond which is open sky.
struct BorderCell {
  Vec2 at{0, 0};
  Vec2 outwards{0, 0};
};

class EdgeFinder {
 public:
  EdgeFinder(const HeightSurvey& survey, const std::vector<SurfaceCell>& cells, const CellIndex& all,
             const Level& level)
      : survey_(survey), cells_(cells), all_(all), level_(level) {}

  /// The edges of one ceiling, longest first.
  std::vector<OpenEdge> find(const SurfaceComponent& ceiling, std::size_t level) const {
    std::vector<BorderCell> border = open_border(ceiling);
    std::vector<OpenEdge> edges;
    while (std::optional<OpenEdge> edge = longest(border)) {
      const Vec2 outwards = take(*edge, border);
      edges.push_back(moved_to_border(*edge, outwards, ceiling));
      edges.back().level = level;
    }
    return edges;
  }

 private:
  Vec2 centre(const SurfaceCell& cell) const { return survey_.raster_m * Vec2(cell.ix + 0.5, cell.iy + 0.5); }

  std::vector<BorderCell> open_border(const SurfaceComponent& ceiling) const {
    const CellIndex own(ceiling.cells);
    std::vector<BorderCell> border;
    for (const SurfaceCell& cell : ceiling.cells) {
      const std::int32_t reach = reach_of(cell, survey_.raster_m);
      BorderCell found{centre(cell), {0, 0}};
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (!own.any_near(cell.ix + dx * reach, cell.iy + dy * reach, reach - 1, level_.lo, level_.hi) &&
            is_open(cell, dx, dy, reach) && has_floor(cell.ix, cell.iy, reach)) {
          found.outwards += Vec2(dx, dy);
        }
      }
      if (found.outwards.norm() > 0 && !has_wall(found)) border.push_back(found);
    }
    return border;
  }

  bool has_floor(std::int32_t ix, std::int32_t iy, std::int32_t reach) const {
    return all_.any_near(ix, iy, reach, -1e9, level_.z - kHeadroom_m);
  }

  /// In the columns up to twice the reach beyond a border cell: a floor below, nothing as high as the
  /// ceiling.
  bool is_open(const SurfaceCell& cell, std::int32_t dx, std::int32_t dy, std::int32_t reach) const {
    double lowest = 1e9, highest = -1e9;
    for (std::int32_t k = reach + 1; k <= 2 * reach + 1; ++k) {
      const auto [from, to] = all_.find(cell.iy + k * dy, cell.ix + k * dx, cell.ix + k * dx);
      for (std::size_t i = from; i < to; ++i) {
        lowest = std::min(lowest, cells_[i].z);
        highest = std::max(highest, cells_[i].z);
      }
    }
    return lowest < level_.z - kHeadroom_m && highest < level_.lo - kOverCeiling_m;
  }

  bool has_wall(const BorderCell& cell) const {
    double most = 0;
    for (const double off : {-0.5, 0.0, 0.5}) {
      const Vec2 p = cell.at + off * kUprightPlan * cell.outwards;
      most =
          std::max(most, upright_m2(floor_to_int(p.x() / kUprightPlan), floor_to_int(p.y() / kUprightPlan)));
    }
    return most > kWallShare * kUprightPlan * kUnderCeiling_m;
  }

  double upright_m2(std::int32_t ix, std::int32_t iy) const {
    const auto before = [](const UprightBlock& b, const std::tuple<std::int32_t, std::int32_t>& wanted) {
      return std::tuple(b.iy, b.ix) < wanted;
    };
    double area = 0;
    for (auto b =
             std::lower_bound(survey_.upright.begin(), survey_.upright.end(), std::tuple(iy, ix), before);
         b != survey_.upright.end() && b->ix == ix && b->iy == iy; ++b) {
      const double above = (b->iz + 0.5) * kUprightHeight - level_.z;
      if (above > -kUnderCeiling_m && above < kOverCeiling_m) area += b->area_m2;
    }
    return area;
  }

  bool lies_on(const BorderCell& cell, const Line2& line) const {
    return std::abs(line.distance(cell.at)) <= survey_.raster_m;
  }

  /// The longest run of border cells on one of the lines through them, in steps of 1 degree and half a
  /// raster.
  std::optional<OpenEdge> longest(const std::vector<BorderCell>& border) const {
    std::optional<OpenEdge> best;
    for (int k = 0; k < kAngles; ++k) {
      const double theta = k * std::numbers::pi / kAngles;
      const Vec2 normal = Line2{theta, 0}.normal();
      std::map<std::int32_t, int> votes;
      for (const BorderCell& cell : border) {
        ++votes[floor_to_int(normal.dot(cell.at) / (0.5 * survey_.raster_m))];
      }
      for (const auto& [bin, count] : votes) {
        const auto beside = [&votes](std::int32_t other) {
          const auto found = votes.find(other);
          return found != votes.end() ? found->second : 0;
        };
        const double most_m =
            (beside(bin - 2) + beside(bin - 1) + count + beside(bin + 1) + beside(bin + 2)) *
            survey_.raster_m / kDense;
        if (most_m < (best ? best->length_m() : kShortest_m)) continue;
        const Line2 line{theta, (bin + 0.5) * 0.5 * survey_.raster_m};
        const std::optional<OpenEdge> run = longest_run(border, line);
        if (run && (!best || run->length_m() > best->length_m() + 1e-9)) best = run;
      }
    }
    return best;
  }

  std::optional<OpenEdge> longest_run(const std::vector<BorderCell>& border, const Line2& line) const {
    std::vector<double> along;
    for (const BorderCell& cell : border) {
      if (lies_on(cell, line)) along.push_back(line.along(cell.at));
    }
    std::sort(along.begin(), along.end());
    const double gap = std::max(kLargestGap_m, 2.5 * survey_.raster_m);
    std::optional<OpenEdge> best;
    for (std::size_t i = 0; i < along.size();) {
      std::size_t j = i;
      while (j + 1 < along.size() && along[j + 1] - along[j] <= gap) ++j;
      const double length = along[j] - along[i];
      const bool dense = static_cast<double>(j - i + 1) * survey_.raster_m >= kDense * length;
      if (length >= kShortest_m && dense && (!best || length > best->length_m())) {
        const double half = 0.5 * survey_.raster_m;
        best = OpenEdge{line.at(along[i] - half), line.at(along[j] + half), 0};
      }
      i = j + 1;
    }
    return best;
  }

  /// Removes the edge's cells, with what is ragged beside it; turns the edge as they lie, and returns the
  /// side to which they are open.
  Vec2 take(OpenEdge& edge, std::vector<BorderCell>& border) const {
    const Line2 line = line_through(edge.a, edge.b);
    const auto [t0, t1] = std::minmax({line.along(edge.a), line.along(edge.b)});
    Vec2 outwards(0, 0);
    double n = 0, t_sum = 0, d_sum = 0, tt = 0, td = 0;
    std::erase_if(border, [&, t0 = t0, t1 = t1](const BorderCell& cell) {
      const double t = line.along(cell.at);
      const double d = line.distance(cell.at);
      const bool on = std::abs(d) <= 1.5 * survey_.raster_m && t > t0 && t < t1;
      if (on) {
        outwards += cell.outwards;
        n += 1;
        t_sum += t;
        d_sum += d;
        tt += t * t;
        td += t * d;
      }
      return on;
    });
    const double slope = (n * td - t_sum * d_sum) / std::max(n * tt - t_sum * t_sum, 1e-9);
    for (Vec2* end : {&edge.a, &edge.b}) {
      *end += (d_sum / n + slope * (line.along(*end) - t_sum / n)) * line.normal();
    }
    return outwards;
  }

  /// The edge where the ceiling's area ends: what lies near the line, by the area that a metre of depth has
  /// farther inside.
  OpenEdge moved_to_border(const OpenEdge& edge, const Vec2& outwards,
                           const SurfaceComponent& ceiling) const {
    const Line2 line = line_through(edge.a, edge.b);
    const double side = line.normal().dot(outwards) < 0 ? -1 : 1;
    const auto [t0, t1] = std::minmax({line.along(edge.a), line.along(edge.b)});
    const double near = 2 * survey_.raster_m;
    const double width = survey_.raster_m * (std::abs(line.normal().x()) + std::abs(line.normal().y()));
    double border_m2 = 0, inside_m2 = 0;
    for (const SurfaceCell& cell : ceiling.cells) {
      const Vec2 p = centre(cell);
      const double t = line.along(p);
      if (t < t0 || t > t1) continue;
      const double out = side * line.distance(p);
      const auto beyond = [&](double from) { return std::clamp((out - from) / width + 0.5, 0.0, 1.0); };
      border_m2 += cell.area_m2 * (beyond(-near) - beyond(near));
      inside_m2 += cell.area_m2 * (beyond(-near - kInside_m) - beyond(-near));
    }
    if (inside_m2 < 0.5 * kInside_m * edge.length_m()) return edge;
    const double out = std::clamp(border_m2 * kInside_m / inside_m2 - near, -near, near);
    const Vec2 move = side * out * line.normal();
    return {edge.a + move, edge.b + move, 0};
  }

  const HeightSurvey& survey_;
  const std::vector<SurfaceCell>& cells_;
  const CellIndex& all_;
  const Level& level_;
};

template <class T>
void reorder(std::vector<T>& values, const std::vector<std::size_t>& order) {
  std::vector<T> sorted;
  sorted.reserve(values.size());
  for (const std::size_t i : order) sorted.push_back(values[i]);
  values = std::move(sorted);
}

void sort_grid(OccupancyGrid& grid) {
  std::vector<std::size_t> order(grid.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(grid.iy[a], grid.ix[a]) < std::tie(grid.iy[b], grid.ix[b]);
  });
  reorder(grid.ix, order);
  reorder(grid.iy, order);
  reorder(grid.x, order);
  reorder(grid.y, order);
  reorder(grid.coverage, order);
  reorder(grid.weight_m, order);
  reorder(grid.area_m2, order);
  reorder(grid.azimuth, order);
  reorder(grid.azimuth_trust, order);
}

}  // namespace

std::vector<OpenEdge> open_edges(const HeightSurvey& survey, const std::vector<SurfaceCell>& cells,
                                 const std::vector<Level>& levels) {
  const CellIndex all(cells);
  std::vector<OpenEdge> edges;
  for (std::size_t k = 1; k < levels.size(); ++k) {
    if (levels[k].cap || levels[k].step) continue;
    const EdgeFinder finder(survey, cells, all, levels[k]);
    for (const SurfaceComponent& ceiling : components(cells, levels[k].lo, levels[k].hi, survey.raster_m)) {
      if (ceiling.area_m2 < kSmallest_m2) break;
      const std::vector<OpenEdge> found = finder.find(ceiling, k);
      edges.insert(edges.end(), found.begin(), found.end());
    }
  }
  return edges;
}

void add_open_edge(const OpenEdge& edge, double tau_m, OccupancyGrid& grid) {
  const auto steps = static_cast<int>(edge.length_m() / tau_m);
  const double azimuth = line_through(edge.a, edge.b).theta;
  const int step = static_cast<int>(azimuth / std::numbers::pi * kAzimuthSteps);
  std::map<std::pair<std::int32_t, std::int32_t>, bool> taken;
  for (std::size_t i = 0; i < grid.size(); ++i) taken[{grid.iy[i], grid.ix[i]}] = true;
  for (int i = 0; i < steps; ++i) {
    const Vec2 p = edge.a + (i + 0.5) / steps * (edge.b - edge.a);
    const std::int32_t ix = floor_to_int(p.x() / tau_m);
    const std::int32_t iy = floor_to_int(p.y() / tau_m);
    if (!taken.emplace(std::pair{iy, ix}, true).second) continue;
    grid.ix.push_back(ix);
    grid.iy.push_back(iy);
    grid.x.push_back(static_cast<float>(p.x()));
    grid.y.push_back(static_cast<float>(p.y()));
    grid.coverage.push_back(1);
    grid.weight_m.push_back(static_cast<float>(tau_m));
    grid.area_m2.push_back(static_cast<float>(tau_m * kUnderCeiling_m));
    grid.azimuth.push_back(static_cast<std::uint8_t>(std::min(step, kAzimuthSteps - 1)));
    grid.azimuth_trust.push_back(255);
  }
  sort_grid(grid);
}

}  // namespace roomcut::slice
