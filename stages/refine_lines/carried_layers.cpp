// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/carried_layers.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "common/cells/interfaces.h"

namespace roomcut::refine_lines {
namespace {

constexpr float kUnseen = 0.5F;       // what a face of the surface counts at least: furniture hides walls
constexpr double kBeside_m = 0.04;    // points so near another line may as well be that one's
constexpr double kSimilar_rad = 0.6;  // lines at larger angles leave each other's neighbourhood at once
constexpr double kGap_m = 0.3;
constexpr double kStep_m = 0.05;
constexpr double kLongEnough_m = 0.3;
constexpr double kShareOfBest = 0.1;

struct Piece {
  double t0, t1;  ///< along the line [m]
  double weight;
};

/// Faces of one line in one layer with no gap over kGap_m between them.
struct Run {
  std::vector<Piece> pieces;  ///< ascending
  double own = 0;             ///< weighted length of what no longer line carries as well [m]
  bool kept = false;
  double t0() const { return pieces.front().t0; }
  double t1() const { return pieces.back().t1; }
};

/// What one line carries in one layer.
struct Load {
  std::size_t line = 0;
  double length = 0;  ///< weighted [m]
  std::vector<Run> runs;
  Eigen::AlignedBox2d box;  ///< of the runs in plan [m]
};

using Loads = std::vector<std::vector<Load>>;  ///< per layer, then line

Loads find_loads(const CellComplex& complex, const FaceWeights& weights,
                 const std::vector<std::uint8_t>& label) {
  std::vector<std::vector<std::vector<Piece>>> pieces(complex.layers(),
                                                      std::vector<std::vector<Piece>>(complex.lines.size()));
  for_each_interface(complex, [&](const Interface& face) {
    if (!face.wall) {
      return;
    }
    const CellComplex::Edge& edge = complex.edges[complex.edge_of_wall(face.index)];
    const float seen = weights.wall_omega[face.index];
    const bool surface = separates(face, label);
    if (!complex.on_wall_line(edge) || (!surface && !weights.is_surely_wall(face.index))) {
      return;
    }
    const auto i = static_cast<std::size_t>(edge.line);
    const Line2& line = complex.lines[i].line;
    const double a = line.along(complex.vertices[static_cast<std::size_t>(edge.v0)]);
    const double b = line.along(complex.vertices[static_cast<std::size_t>(edge.v1)]);
    pieces[complex.layer_of_wall(face.index)][i].push_back(
        {std::min(a, b), std::max(a, b), surface ? std::max(seen, kUnseen) : seen});
  });
  Loads loads(complex.layers(), std::vector<Load>(complex.lines.size()));
  for (std::size_t k = 0; k < loads.size(); ++k) {
    for (std::size_t i = 0; i < complex.lines.size(); ++i) {
      Load& load = loads[k][i];
      load.line = i;
      std::sort(pieces[k][i].begin(), pieces[k][i].end(),
                [](const Piece& x, const Piece& y) { return std::pair(x.t0, x.t1) < std::pair(y.t0, y.t1); });
      for (const Piece& piece : pieces[k][i]) {
        if (load.runs.empty() || piece.t0 > load.runs.back().t1() + kGap_m) {
          load.runs.emplace_back();
        }
        load.runs.back().pieces.push_back(piece);
        load.box.extend(complex.lines[i].line.at(piece.t0));
        load.box.extend(complex.lines[i].line.at(piece.t1));
        load.length += piece.weight * (piece.t1 - piece.t0);
      }
    }
  }
  return loads;
}

bool carries_at(const Load& load, double t) {
  return std::any_of(load.runs.begin(), load.runs.end(),
                     [&](const Run& run) { return run.t0() - kBeside_m < t && t < run.t1() + kBeside_m; });
}

/// What the runs of `load` carry beside everything that the `longer` ones carry.
void measure_own(const CellComplex& complex, const std::vector<const Load*>& longer, Load& load) {
  const Line2& line = complex.lines[load.line].line;
  const Vec2 reach = Vec2::Constant(2 * kBeside_m);
  const Eigen::AlignedBox2d around(load.box.min() - reach, load.box.max() + reach);
  std::vector<const Load*> near;
  std::copy_if(longer.begin(), longer.end(), std::back_inserter(near), [&](const Load* other) {
    return around.intersects(other->box) &&
           angle_between(complex.lines[other->line].line.theta, line.theta) < kSimilar_rad;
  });
  const auto is_beside = [&](const Vec2& place) {
    return std::any_of(near.begin(), near.end(), [&](const Load* other) {
      const Line2& to = complex.lines[other->line].line;
      return std::abs(to.distance(place)) < kBeside_m && carries_at(*other, to.along(place));
    });
  };
  for (Run& run : load.runs) {
    for (const Piece& piece : run.pieces) {
      const double steps = std::ceil((piece.t1 - piece.t0) / kStep_m);
      const double step = (piece.t1 - piece.t0) / steps;
      for (double k = 0.5; k < steps; ++k) {
        run.own += is_beside(line.at(piece.t0 + k * step)) ? 0 : piece.weight * step;
      }
    }
  }
}

/// Keeps the runs that are long enough, and those above and below one that is kept: walls are upright.
void choose_runs(Loads& loads, std::size_t line) {
  double best = 0;
  for (const std::vector<Load>& layer : loads) {
    for (const Run& run : layer[line].runs) {
      best = std::max(best, run.own);
    }
  }
  const double enough = std::min(kLongEnough_m, kShareOfBest * best);
  for (std::vector<Load>& layer : loads) {
    for (Run& run : layer[line].runs) {
      run.kept = run.own > 0 && run.own >= enough;
    }
  }
  const auto pass_on = [&](std::size_t from, std::size_t to) {
    for (const Run& kept : loads[from][line].runs) {
      for (Run& run : loads[to][line].runs) {
        run.kept = run.kept || (kept.kept && kept.t0() < run.t1() && run.t0() < kept.t1());
      }
    }
  };
  for (std::size_t k = 1; k < loads.size(); ++k) {
    pass_on(k - 1, k);
  }
  for (std::size_t k = loads.size(); k-- > 1;) {
    pass_on(k, k - 1);
  }
}

}  // namespace

bool CarriedLine::holds(std::size_t layer, double t) const {
  return !known || std::any_of(runs.begin(), runs.end(), [&](const CarriedRun& run) {
    return run.layer == layer && run.t0 <= t && t <= run.t1;
  });
}

CarriedRuns find_carried_runs(const CellComplex& complex, const FaceWeights& weights,
                              const std::vector<std::uint8_t>& label) {
  Loads loads = find_loads(complex, weights, label);
  tbb::parallel_for(std::size_t{0}, loads.size(), [&](std::size_t k) {
    std::vector<Load>& layer = loads[k];
    std::vector<std::size_t> order(layer.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return layer[a].length > layer[b].length; });
    std::vector<const Load*> longer;
    for (const std::size_t i : order) {
      if (!layer[i].runs.empty()) {
        measure_own(complex, longer, layer[i]);
        longer.push_back(&layer[i]);
      }
    }
  });
  CarriedRuns carried(complex.lines.size());
  for (std::size_t i = 0; i < carried.size(); ++i) {
    choose_runs(loads, i);
    for (std::size_t k = 0; k < loads.size(); ++k) {
      for (const Run& run : loads[k][i].runs) {
        carried[i].known = true;
        if (run.kept) {
          carried[i].runs.push_back({k, run.t0(), run.t1()});
        }
      }
    }
  }
  return carried;
}

void restrict_to_carried_layers(const CellComplex& complex, const std::set<std::string>& one_sided,
                                CarriedRuns& carried, WallLines& lines) {
  std::map<std::string, std::size_t> by_id;
  for (std::size_t i = 0; i < complex.lines.size(); ++i) {
    by_id.emplace(complex.lines[i].wall_id, i);
  }
  for (WallLine& wall : lines.lines) {
    const auto found = by_id.find(wall.id);
    if (found == by_id.end()) {
      continue;
    }
    CarriedLine& line = carried[found->second];
    if (wall.levels) {
      std::erase_if(line.runs, [&](const CarriedRun& run) {
        return !std::binary_search(wall.levels->begin(), wall.levels->end(), static_cast<int>(run.layer));
      });
    }
    if (wall.locked || wall.source != LineSource::kDetected || !line.known ||
        (line.runs.empty() && one_sided.contains(wall.id))) {
      line = {};
      continue;
    }
    std::set<int> layers;
    for (const CarriedRun& run : line.runs) {
      layers.insert(static_cast<int>(run.layer));
    }
    if (layers.size() < complex.layers()) {
      wall.levels = std::vector<int>(layers.begin(), layers.end());
    }
  }
}

}  // namespace roomcut::refine_lines
