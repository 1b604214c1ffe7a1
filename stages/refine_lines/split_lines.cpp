// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/split_lines.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

namespace roomcut::refine_lines {

namespace {

constexpr std::size_t kFewestObservations = 8;  ///< a panel with fewer has no say
constexpr double kSignificant = 4.0;            ///< standard deviations

struct Panel {
  std::vector<std::size_t> cells;  ///< of the raster
  std::vector<Observation> observations;
  double area_m2 = 0;
  double offset_m = 0, variance_m2 = 0;  ///< from the line, along the common direction
  int group = -1;
};

/// Connected cells of the raster with the empty space on one side; `panel_of` gets the panel of each cell.
std::vector<Panel> find_panels(const LineFaces& faces, const std::vector<double>& layer_height,
                               std::vector<int>& panel_of) {
  std::vector<Panel> panels;
  panel_of.assign(faces.side.size(), -1);
  std::vector<std::size_t> open;
  for (std::size_t first = 0; first < faces.side.size(); ++first) {
    if (faces.side[first] == 0 || panel_of[first] >= 0) {
      continue;
    }
    Panel panel;
    const auto number = static_cast<int>(panels.size());
    const auto reach = [&](std::size_t cell) {
      if (panel_of[cell] < 0 && faces.side[cell] == faces.side[first]) {
        panel_of[cell] = number;
        open.push_back(cell);
      }
    };
    reach(first);
    while (!open.empty()) {
      const std::size_t cell = open.back();
      open.pop_back();
      panel.cells.push_back(cell);
      const std::size_t bin = cell / faces.layers;
      const std::size_t layer = cell % faces.layers;
      panel.area_m2 += faces.bin_m * layer_height[layer];
      if (bin > 0) reach(cell - faces.layers);
      if (bin + 1 < faces.bins) reach(cell + faces.layers);
      if (layer > 0) reach(cell - 1);
      if (layer + 1 < faces.layers) reach(cell + 1);
    }
    panels.push_back(std::move(panel));
  }
  return panels;
}

/// Fits every panel that has enough observations and states its offset from the line along the direction
/// that all of them agree on. Returns those panels.
std::vector<std::size_t> measure(const Line2& line, const LinePrior& prior, std::vector<Panel>& panels) {
  struct Fitted {
    Vec2 place;
    double turn, turn_variance, variance;
  };
  std::vector<std::size_t> order;
  std::vector<Fitted> fits;
  double weights = 0, turn = 0, along = 0, area = 0;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (panels[i].observations.size() < kFewestObservations) {
      continue;
    }
    LineProblem problem = make_problem(line, line.at(0), panels[i].observations, prior);
    const LineFit fit = fit_line(problem);
    const Line2 fitted = posed(line, problem.centre, fit.pose);
    const Vec2 place = problem.centre - fitted.distance(problem.centre) * fitted.normal();
    fits.push_back({place, fit.pose.turn, fit.covariance.turn_turn, fit.covariance.shift_shift});
    order.push_back(i);
    weights += 1 / fit.covariance.turn_turn;
    turn += fit.pose.turn / fit.covariance.turn_turn;
    along += panels[i].area_m2 * line.along(place);
    area += panels[i].area_m2;
  }
  if (fits.size() < 2) {
    return {};
  }
  turn /= weights;
  const Vec2 middle = line.at(along / area);
  const Line2 common = posed(line, middle, {turn, 0});
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double lever = common.along(fits[k].place) - common.along(middle);
    panels[order[k]].offset_m = common.distance(fits[k].place);
    panels[order[k]].variance_m2 = fits[k].variance + lever * lever / weights;
  }
  return order;
}

/// Numbers the groups of neighbouring offsets; returns how many.
int group_panels(std::vector<Panel>& panels, std::vector<std::size_t> order, double apart_m) {
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(panels[a].offset_m, a) < std::pair(panels[b].offset_m, b);
  });
  int group = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    Panel& panel = panels[order[k]];
    if (k > 0) {
      const Panel& before = panels[order[k - 1]];
      const double sigma = std::sqrt(panel.variance_m2 + before.variance_m2);
      group += panel.offset_m - before.offset_m > std::max(apart_m, kSignificant * sigma) ? 1 : 0;
    }
    panel.group = group;
  }
  return group + 1;
}

/// Panels that had no say: to the group of the panel whose cells lie nearest in the raster.
void place_others(const LineFaces& faces, std::vector<Panel>& panels) {
  const auto bins = [&](const Panel& panel) {
    const auto [low, high] = std::minmax_element(panel.cells.begin(), panel.cells.end());
    const std::size_t first = *low / faces.layers;
    const std::size_t last = *high / faces.layers;
    return std::pair(static_cast<double>(first), static_cast<double>(last));
  };
  std::vector<int> found(panels.size());
  for (std::size_t i = 0; i < panels.size(); ++i) {
    found[i] = panels[i].group;
    double nearest = std::numeric_limits<double>::max();
    const auto [low, high] = bins(panels[i]);
    for (const Panel& other : panels) {
      if (panels[i].group >= 0 || other.group < 0) {
        continue;
      }
      const auto [from, to] = bins(other);
      const double gap = std::max({0.0, from - high, low - to});
      const double levels = std::abs(static_cast<double>(panels[i].cells.front() % faces.layers) -
                                     static_cast<double>(other.cells.front() % faces.layers));
      if (gap + levels < nearest) {
        nearest = gap + levels;
        found[i] = other.group;
      }
    }
  }
  for (std::size_t i = 0; i < panels.size(); ++i) {
    panels[i].group = found[i];
  }
}

/// The group of every cell of the raster: that of its panel, or of the nearest one in its layer. Where the
/// first cut saw no wall the second still needs a line to find one. -1 in layers without a panel.
std::vector<int> spread_groups(const LineFaces& faces, const std::vector<Panel>& panels) {
  std::vector<int> group(faces.side.size(), -1);
  for (const Panel& panel : panels) {
    for (const std::size_t cell : panel.cells) {
      group[cell] = panel.group;
    }
  }
  std::vector<std::size_t> known;  // bins
  for (std::size_t layer = 0; layer < faces.layers; ++layer) {
    known.clear();
    for (std::size_t bin = 0; bin < faces.bins; ++bin) {
      if (group[bin * faces.layers + layer] >= 0) known.push_back(bin);
    }
    std::size_t next = 0;
    for (std::size_t bin = 0; bin < faces.bins && !known.empty(); ++bin) {
      while (next + 1 < known.size() && known[next + 1] <= bin) ++next;
      const bool after =
          next + 1 < known.size() && known[next] < bin && known[next + 1] - bin < bin - known[next];
      group[bin * faces.layers + layer] = group[known[next + (after ? 1 : 0)] * faces.layers + layer];
    }
  }
  return group;
}

/// The line's faces without those of other groups, cut to the hull of what is the group's.
LinePart part_of(const LineFaces& faces, const std::vector<Panel>& panels, const std::vector<int>& spread,
                 const std::vector<double>& layer_height, int group) {
  LinePart part{faces, {}, {}};
  part.faces.side.assign(faces.side.size(), 0);
  for (const Panel& panel : panels) {
    if (panel.group != group) {
      continue;
    }
    part.observations.insert(part.observations.end(), panel.observations.begin(), panel.observations.end());
    for (const std::size_t cell : panel.cells) {
      part.faces.side[cell] = faces.side[cell];
    }
  }
  const auto begin = std::find(spread.begin(), spread.end(), group);
  const auto end = std::find(spread.rbegin(), spread.rend(), group).base();
  const std::size_t first = static_cast<std::size_t>(begin - spread.begin()) / faces.layers;
  const std::size_t last = static_cast<std::size_t>(end - 1 - spread.begin()) / faces.layers;
  part.faces = slice_bins(part.faces, first, last + 1, layer_height);
  for (Observation& o : part.observations) {
    o.bin -= first;
  }
  for (std::size_t layer = 0; layer < faces.layers; ++layer) {
    bool own = false;
    bool others = false;
    for (std::size_t bin = 0; bin < faces.bins; ++bin) {
      const int found = spread[bin * faces.layers + layer];
      own = own || found == group;
      others = others || (found >= 0 && found != group);
    }
    if (own || !others) {
      part.layers.push_back(static_cast<int>(layer));
    }
  }
  std::sort(part.observations.begin(), part.observations.end(),
            [](const Observation& a, const Observation& b) {
              return std::pair(a.zone, a.bin) < std::pair(b.zone, b.bin);
            });
  return part;
}

}  // namespace

std::vector<LinePart> split_line(const LineFaces& faces, const std::vector<Observation>& observations,
                                 const std::vector<double>& layer_height, const LinePrior& prior,
                                 double apart_m) {
  std::vector<int> panel_of;
  std::vector<Panel> panels = find_panels(faces, layer_height, panel_of);
  for (const Observation& o : observations) {
    const int panel = panel_of[o.bin * faces.layers + o.layer];
    if (panel >= 0) {
      panels[static_cast<std::size_t>(panel)].observations.push_back(o);
    }
  }
  const std::vector<std::size_t> order = measure(faces.line, prior, panels);
  const int groups = order.empty() ? 1 : group_panels(panels, order, apart_m);
  if (groups < 2) {
    LinePart whole{faces, observations, std::vector<int>(faces.layers)};
    std::iota(whole.layers.begin(), whole.layers.end(), 0);
    return {std::move(whole)};
  }
  place_others(faces, panels);
  const std::vector<int> spread = spread_groups(faces, panels);
  std::vector<LinePart> parts;
  parts.reserve(static_cast<std::size_t>(groups));
  for (int group = 0; group < groups; ++group) {
    parts.push_back(part_of(faces, panels, spread, layer_height, group));
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const LinePart& a, const LinePart& b) { return a.faces.area_m2 > b.faces.area_m2; });
  return parts;
}

std::optional<std::vector<int>> levels_of(const LinePart& part,
                                          const std::optional<std::vector<int>>& whole) {
  if (!whole) {
    return part.layers.size() < part.faces.layers ? std::optional(part.layers) : std::nullopt;
  }
  std::vector<int> both;
  std::set_intersection(whole->begin(), whole->end(), part.layers.begin(), part.layers.end(),
                        std::back_inserter(both));
  return both.empty() ? whole : both;
}

double steps_to(const LinePart& part, const OneSidedWall& wall) {
  const LineFaces& faces = part.faces;
  double nearest = std::numeric_limits<double>::max();
  for (std::size_t cell = 0; cell < faces.side.size(); ++cell) {
    if (faces.side[cell] == 0) {
      continue;
    }
    const std::size_t bin = cell / faces.layers;
    const double t = faces.t0 + (static_cast<double>(bin) + 0.5) * faces.bin_m;
    const double bins = std::max({0.0, wall.t0 - t, t - wall.t1}) / faces.bin_m;
    for (const std::int32_t layer : wall.layers) {
      const double layers = std::abs(static_cast<double>(cell % faces.layers) - layer);
      nearest = std::min(nearest, bins + layers);
    }
  }
  return nearest;
}

}  // namespace roomcut::refine_lines
