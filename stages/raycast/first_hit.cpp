// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/first_hit.h"

#include <algorithm>
#include <cmath>

namespace roomcut::raycast {
namespace {

constexpr double kThickness = 0.5;  // [m] of walls and slabs: how far behind a surface solid is likely
constexpr double kOpaque = 1e-3;    // a ray of which less is left has ended

double mean_way(double share, double weighted) {
  return share > 0 ? weighted / share : 0;
}

double thin(double between_m, const LineLengths& lengths) {
  return 1 - std::clamp((between_m - lengths.thin_m) / (lengths.wide_m - lengths.thin_m), 0.0, 1.0);
}

}  // namespace

double FirstHit::nothing() const {
  return std::max(0.0, 1 - front - back);
}

void FirstHit::add(const FirstHit& other, double weight) {
  front += weight * other.front;
  back += weight * other.back;
  near_back += weight * other.near_back;
  front_m += weight * other.front_m;
  back_m += weight * other.back_m;
}

FirstHit first_hit(const std::vector<Crossing>& crossings) {
  FirstHit hit;
  double left = 1;
  for (const Crossing& c : crossings) {
    if (left < kOpaque) {
      break;
    }
    hit.front += left * c.front;
    hit.front_m += left * c.front * c.distance;
    hit.back += left * c.back;
    if (c.back > 0) {  // few are: the rest need no exponential function
      hit.near_back += left * c.back * std::exp(-c.distance / kThickness);
      hit.back_m += left * c.back * c.distance;
    }
    left *= 1 - c.front - c.back;
  }
  return hit;
}

LineEnds LineEnds::mean(int lines) const {
  const double share = 1.0 / std::max(1, lines);
  return {share * fronts,         share * backs_thin, share * backs_wide,
          share * front_back_low, share * one_open,   share * both_open};
}

void LineEnds::add(const FirstHit& one, const FirstHit& other, const LineLengths& lengths, double weight) {
  const double to_front[] = {mean_way(one.front, one.front_m), mean_way(other.front, other.front_m)};
  const double to_back[] = {mean_way(one.back, one.back_m), mean_way(other.back, other.back_m)};
  fronts += weight * one.front * other.front;
  front_back_low += weight * (one.front * other.back * thin(to_front[0] + to_back[1], lengths) +
                              one.back * other.front * thin(to_back[0] + to_front[1], lengths));
  const double backs = weight * one.back * other.back;
  const double between = to_back[0] + to_back[1];
  const double near = 1 - std::clamp((between - lengths.far_m) / lengths.far_m, 0.0, 1.0);
  backs_thin += backs * thin(between, lengths);
  backs_wide += backs * (1 - thin(between, lengths)) * near;
  both_open += weight * one.nothing() * other.nothing();
  one_open += weight * (one.nothing() + other.nothing() - 2 * one.nothing() * other.nothing());
}

}  // namespace roomcut::raycast
