// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/bends.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace roomcut::refine_lines {

namespace {

constexpr double kDeg = std::numbers::pi / 180;
constexpr double kOff_m = 0.006;     ///< from the line, at least; walls are uneven
constexpr double kOffSigmas = 4;     ///< of the observation
constexpr double kBegins_m = 0.025;  ///< from the line where it leaves it, at most
constexpr double kLeast_rad = 3 * kDeg, kMost_rad = 20 * kDeg;
constexpr double kStraight_m =
    0.004;  ///< what the observations of a wall scatter about it, beyond their sigma
constexpr double kShortest_m = 0.3;
constexpr double kSame_m = 0.01;  ///< runs of one wall, from each other's line
constexpr double kSame_rad = 3 * kDeg;
constexpr double kGap_m = 0.3;  ///< between two runs of one wall: around where their lines meet

/// Consecutive bins in which most observations lie off the line, on one side.
struct Run {
  std::size_t parent;
  std::vector<Observation> observations;
  Line2 line;
  Vec2 centre;
  double t0 = 0, t1 = 0;  ///< along `line`
  bool used = false;
};

/// Line of least squares through the observations, and their hull along it.
void fit(Run& run) {
  Vec2 sum(0, 0);
  for (const Observation& o : run.observations) sum += o.point;
  run.centre = sum / static_cast<double>(run.observations.size());
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const Observation& o : run.observations) {
    const Vec2 p = o.point - run.centre;
    moments += p * p.transpose();
  }
  const Vec2 along = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(moments).eigenvectors().col(1);
  run.line = line_through(run.centre, run.centre + along);
  run.t0 = run.t1 = run.line.along(run.centre);
  for (const Observation& o : run.observations) {
    run.t0 = std::min(run.t0, run.line.along(o.point));
    run.t1 = std::max(run.t1, run.line.along(o.point));
  }
}

bool is_straight(const Run& run) {
  double squares = 0, expected = 0;
  for (const Observation& o : run.observations) {
    squares += std::pow(run.line.distance(o.point), 2);
    expected += o.variance_m2 + kStraight_m * kStraight_m;
  }
  return squares <= expected;
}

/// +1, -1: most of what was seen in the bin lies off the line on that side; 0: it lies on it, or nothing was
/// seen. `offset` gets the mean of those.
int side_of_bin(const std::vector<const Observation*>& bin, const Line2& line, double& offset) {
  std::size_t count[2] = {0, 0};
  double sum[2] = {0, 0};
  for (const Observation* o : bin) {
    const double e = line.distance(o->point);
    if (std::abs(e) > std::max(kOff_m, kOffSigmas * std::sqrt(o->variance_m2))) {
      ++count[e > 0];
      sum[e > 0] += e;
    }
  }
  for (const int s : {0, 1}) {
    if (2 * count[s] > bin.size()) {
      offset = std::abs(sum[s]) / static_cast<double>(count[s]);
      return s == 1 ? 1 : -1;
    }
  }
  return 0;
}

void find_runs(const FittedLine& fitted, std::size_t parent, std::vector<Run>& runs) {
  std::map<std::size_t, std::vector<const Observation*>> bins;
  for (const Observation& o : *fitted.observations) bins[o.bin].push_back(&o);
  std::vector<Observation> open;
  int side = 0;
  std::size_t last = 0;
  double first_offset = 0, last_offset = 0;
  const auto close = [&] {
    if (side != 0 && open.size() >= 4 && std::min(first_offset, last_offset) <= kBegins_m) {
      Run run{parent, std::move(open), {}, {}, 0, 0, false};
      fit(run);
      const double turn = angle_between(run.line.theta, fitted.line.theta);
      if (run.t1 - run.t0 >= fitted.faces->bin_m && turn >= kLeast_rad && turn <= kMost_rad &&
          is_straight(run)) {
        runs.push_back(std::move(run));
      }
    }
    open.clear();
    side = 0;
  };
  for (const auto& [bin, observations] : bins) {
    double offset = 0;
    const int now = side_of_bin(observations, fitted.line, offset);
    if (side != 0 && (now != side || bin > last + 1)) close();
    if (now != 0) {
      if (side == 0) first_offset = offset;
      last_offset = offset;
      for (const Observation* o : observations) {
        if (now * fitted.line.distance(o->point) > kOff_m) open.push_back(*o);
      }
    }
    side = now;
    last = bin;
  }
  close();
}

bool is_one_wall(const Run& a, const Run& b) {
  const auto gap = [](const Run& run, const Vec2& p) {
    const double t = run.line.along(p);
    return std::max({0.0, run.t0 - t, t - run.t1});
  };
  return angle_between(a.line.theta, b.line.theta) <= kSame_rad &&
         std::abs(a.line.distance(b.centre)) <= kSame_m && std::abs(b.line.distance(a.centre)) <= kSame_m &&
         gap(a, b.centre) - 0.5 * (b.t1 - b.t0) <= kGap_m;
}

bool has_line(const Run& run, const std::vector<FittedLine>& lines) {
  return std::any_of(lines.begin(), lines.end(), [&](const FittedLine& other) {
    const double t = other.faces->line.along(run.centre);
    return angle_between(other.line.theta, run.line.theta) < kSame_rad &&
           std::abs(other.line.distance(run.centre)) < kSame_m && t >= other.faces->t0 &&
           t <= other.faces->t1;
  });
}

/// The bend's surface: where it was observed, facing as its parents' does.
Bend bend_of(const Run& run, const std::vector<FittedLine>& lines, const std::vector<std::size_t>& parents,
             const std::vector<double>& layer_height) {
  Bend bend{run.parent, {}, run.observations};
  const LineFaces& like = *lines[run.parent].faces;
  LineFaces& faces = bend.faces;
  faces.line = run.line;
  faces.layers = like.layers;
  faces.t0 = run.t0 - 0.5 * like.bin_m;
  faces.t1 = run.t1 + 0.5 * like.bin_m;
  faces.bins = static_cast<std::size_t>(std::max(1.0, std::round((faces.t1 - faces.t0) / like.bin_m)));
  faces.bin_m = (faces.t1 - faces.t0) / static_cast<double>(faces.bins);
  faces.side.assign(faces.bins * faces.layers, 0);
  for (std::size_t i = 0; i < bend.observations.size(); ++i) {
    Observation& o = bend.observations[i];
    const LineFaces& own = *lines[parents[i]].faces;
    const int side = own.side_at(o.bin, o.layer) * (own.line.normal().dot(run.line.normal()) > 0 ? 1 : -1);
    o.bin = std::min(faces.bins - 1,
                     static_cast<std::size_t>((run.line.along(o.point) - faces.t0) / faces.bin_m));
    for (std::size_t bin = 0; bin < faces.bins; ++bin) {
      faces.side[bin * faces.layers + o.layer] = static_cast<std::int8_t>(side);
    }
  }
  for (std::size_t layer = 0; layer < faces.layers; ++layer) {
    faces.area_m2 += faces.side_at(0, layer) != 0 ? (faces.t1 - faces.t0) * layer_height[layer] : 0;
  }
  std::sort(bend.observations.begin(), bend.observations.end(),
            [](const Observation& a, const Observation& b) {
              return std::tuple(a.zone, a.bin, a.point.x(), a.point.y()) <
                     std::tuple(b.zone, b.bin, b.point.x(), b.point.y());
            });
  return bend;
}

}  // namespace

std::vector<Bend> find_bends(const std::vector<FittedLine>& lines, const std::vector<double>& layer_height) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    find_runs(lines[i], i, runs);
  }
  // The longest first, so that a short run joins the wall and not the other way round.
  std::stable_sort(runs.begin(), runs.end(),
                   [](const Run& a, const Run& b) { return a.t1 - a.t0 > b.t1 - b.t0; });
  std::vector<Bend> bends;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].used) continue;
    Run wall = runs[i];
    std::vector<std::size_t> parents(wall.observations.size(), wall.parent);
    for (std::size_t k = i + 1; k < runs.size(); ++k) {
      if (runs[k].used || !is_one_wall(wall, runs[k])) continue;
      runs[k].used = true;
      wall.observations.insert(wall.observations.end(), runs[k].observations.begin(),
                               runs[k].observations.end());
      parents.resize(wall.observations.size(), runs[k].parent);
      fit(wall);
    }
    if (wall.t1 - wall.t0 >= kShortest_m && is_straight(wall) && !has_line(wall, lines)) {
      bends.push_back(bend_of(wall, lines, parents, layer_height));
    }
  }
  std::stable_sort(bends.begin(), bends.end(),
                   [](const Bend& a, const Bend& b) { return a.parent < b.parent; });
  return bends;
}

}  // namespace roomcut::refine_lines
