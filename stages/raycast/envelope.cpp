// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/raycast/envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace roomcut::raycast {
namespace {

constexpr double kSame_rad = 3.0 / 180 * std::numbers::pi;   // lines of one direction
constexpr double kOther_rad = 6.0 / 180 * std::numbers::pi;  // from here on another one
constexpr double kShare = 1.0 / 12;                          // of the covered wall area

struct Heading {
  double azimuth;  // 0 … pi
  double area;     // covered [m^2]
};

/// From `from` to `to`, -pi/2 … pi/2: lines have no sense.
double turn(double from, double to) {
  return std::remainder(to - from, std::numbers::pi);
}

std::vector<Heading> headings(const CellComplex& complex, const FaceWeights& weights) {
  std::vector<Heading> all;
  for (const CellComplex::Line& line : complex.lines) {
    const Vec2 along = line.line.direction();
    all.push_back({std::atan2(along.y(), along.x()), 0});
  }
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    for (std::size_t k = 0; k < complex.layers() && complex.on_wall_line(complex.edges[e]); ++k) {
      all[static_cast<std::size_t>(complex.edges[e].line)].area +=
          weights.wall_omega[complex.wall_face(e, k)] * complex.length(e) * complex.height(k);
    }
  }
  std::sort(all.begin(), all.end(), [](const Heading& a, const Heading& b) {
    return a.area > b.area || (a.area == b.area && a.azimuth < b.azimuth);
  });
  return all;
}

double area_near(const std::vector<Heading>& all, double azimuth) {
  double area = 0;
  for (const Heading& h : all) {
    area += std::abs(turn(azimuth, h.azimuth)) <= kSame_rad ? h.area : 0;
  }
  return area;
}

/// Mean of the headings near one, weighted by area.
double mean_near(const std::vector<Heading>& all, double azimuth) {
  double sum = 0;
  double area = 0;
  for (const Heading& h : all) {
    const double off = turn(azimuth, h.azimuth);
    sum += std::abs(off) <= kSame_rad ? h.area * off : 0;
    area += std::abs(off) <= kSame_rad ? h.area : 0;
  }
  return azimuth + sum / area;
}

/// The farthest that a corner of the faces indoors reaches along a direction.
double reach(const CellComplex& complex, const std::vector<std::uint8_t>& face_indoors, const Vec2& to) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < complex.faces(); ++f) {
    if (face_indoors[f] != 0) {
      for (const Vec2& corner : complex.corners(f)) {
        farthest = std::max(farthest, corner.dot(to));
      }
    }
  }
  return farthest;
}

}  // namespace

std::vector<Vec2> wall_directions(const CellComplex& complex, const FaceWeights& weights) {
  std::vector<Heading> left = headings(complex, weights);
  double all = 0;
  for (const Heading& h : left) {
    all += h.area;
  }
  std::vector<Vec2> directions;
  while (all > 0 && !left.empty()) {
    double most = 0;
    double best = 0;
    for (const Heading& h : left) {
      if (const double area = area_near(left, h.azimuth); area > most) {
        most = area;
        best = h.azimuth;
      }
    }
    if (most < kShare * all) {
      break;
    }
    const double azimuth = mean_near(left, best);
    directions.emplace_back(std::cos(azimuth), std::sin(azimuth));
    std::erase_if(left, [&](const Heading& h) { return std::abs(turn(best, h.azimuth)) <= kOther_rad; });
  }
  return directions;
}

std::vector<double> beyond_envelope(const CellComplex& complex, const FaceWeights& weights,
                                    const std::vector<std::uint8_t>& indoors) {
  std::vector<std::uint8_t> face_indoors(complex.faces(), 0);
  for (std::size_t c = 0; c < indoors.size(); ++c) {
    face_indoors[complex.face_of(c)] |= indoors[c];
  }
  std::vector<double> beyond(complex.faces(), 0);
  if (std::find(face_indoors.begin(), face_indoors.end(), 1) == face_indoors.end()) {
    return beyond;
  }
  for (const Vec2& along : wall_directions(complex, weights)) {
    for (const Vec2& out : {Vec2(-along.y(), along.x()), Vec2(along.y(), -along.x())}) {
      const double farthest = reach(complex, face_indoors, out);
      for (std::size_t f = 0; f < complex.faces(); ++f) {
        beyond[f] = std::max(beyond[f], complex.centroid(f).dot(out) - farthest);
      }
    }
  }
  return beyond;
}

}  // namespace roomcut::raycast
