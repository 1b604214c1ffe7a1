// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/refine_lines/line_item.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace roomcut::refine_lines {

namespace {

/// The interval that the line must have in the second pass: everywhere it carries surface; a user's line also
/// where drawn.
void set_ends(WallLine& wall, const LineItem& item, const Line2& line) {
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
double covered_length(const LineItem& item, const Line2& line) {
  const double bin = item.faces.empty() ? 1 : item.faces.front().bin_m;
  std::set<long> bins;
  for (const Observation& o : item.observations) {
    bins.insert(std::lround(std::floor(line.along(o.point) / bin)));
  }
  return bin * static_cast<double>(bins.size());
}

void set_measures(WallLine& wall, const LineItem& item, const Line2& line) {
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

}  // namespace

WallLine refined(const LineItem& item) {
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

}  // namespace roomcut::refine_lines
