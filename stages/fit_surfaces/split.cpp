// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/split.h"

#include <algorithm>
#include <map>
#include <utility>

#include "stages/fit_surfaces/model_choice.h"
#include "stages/fit_surfaces/two_heights.h"

namespace roomcut::fit_surfaces {
namespace {

constexpr double kTells = 0.5;   // patches that a face must have to say where it lies
constexpr double kPure = 0.85;   // share of them that agree
constexpr double kMixed = 0.15;  // of the smaller part: that much may lie in faces of both heights
constexpr double kFewest = 3;    // patches of a part

enum Side : std::int8_t { kOpen = -1, kLow = 0, kHigh = 1 };

/// Per face of the region, in its order.
struct Votes {
  std::vector<Side> side;
  double patches[2] = {0, 0};
  double mixed = 0;
};

Votes count_votes(const FaceSamples& samples, const Region& region, const TwoHeights& two) {
  Votes votes;
  std::size_t at = 0;
  for (const std::size_t face : region.faces) {
    double share[2] = {0, 0};
    for (const Sample& s : samples.of(face)) {
      share[two.is_high[at++] ? kHigh : kLow] += s.share;
    }
    const double all = share[kLow] + share[kHigh];
    const Side larger = share[kHigh] > share[kLow] ? kHigh : kLow;
    const bool tells = all >= kTells && share[larger] >= kPure * all;
    votes.side.push_back(tells ? larger : kOpen);
    votes.patches[larger] += tells ? all : 0;
    votes.mixed += all >= kTells && !tells ? all : 0;
  }
  return votes;
}

/// Gives open faces the side that most of their border has, from those next to decided ones on outwards;
/// what borders on none is low.
void settle_open(const CellComplex& complex, const Region& region, std::vector<Side>& side) {
  std::map<std::size_t, std::size_t> place;
  for (std::size_t i = 0; i < region.faces.size(); ++i) {
    place[complex.face_of_level(region.faces[i])] = i;
  }
  for (bool moved = true; moved;) {
    moved = false;
    std::vector<std::pair<std::size_t, Side>> found;
    for (const auto& [face, i] : place) {
      double border[2] = {0, 0};
      for (const std::int32_t e : complex.edges_of(face)) {
        const std::int32_t beside =
            complex.edges[static_cast<std::size_t>(e)].across(static_cast<std::int32_t>(face));
        const auto other = beside < 0 ? place.end() : place.find(static_cast<std::size_t>(beside));
        if (side[i] == kOpen && other != place.end() && side[other->second] != kOpen) {
          border[side[other->second]] += complex.length(static_cast<std::size_t>(e));
        }
      }
      if (border[kLow] + border[kHigh] > 0) {
        found.emplace_back(i, border[kHigh] > border[kLow] ? kHigh : kLow);
      }
    }
    for (const auto& [i, to] : found) {
      side[i] = to;
      moved = true;
    }
  }
  std::replace(side.begin(), side.end(), kOpen, kLow);
}

}  // namespace

std::vector<Sample> FaceSamples::of_all(const std::vector<std::size_t>& level_faces) const {
  std::vector<Sample> result;
  for (const std::size_t face : level_faces) {
    const std::span<const Sample> of_face = of(face);
    result.insert(result.end(), of_face.begin(), of_face.end());
  }
  return result;
}

Vec2 middle_of(const CellComplex& complex, const Region& region) {
  Vec2 sum(0, 0);
  for (const std::size_t face : region.faces) {
    const std::size_t f = complex.face_of_level(face);
    sum += complex.area(f) * complex.centroid(f);
  }
  return sum / area_of(complex, region);
}

double area_of(const CellComplex& complex, const Region& region) {
  double sum = 0;
  for (const std::size_t face : region.faces) {
    sum += complex.area(complex.face_of_level(face));
  }
  return sum;
}

std::vector<Region> split_by_height(const CellComplex& complex, const FaceSamples& samples, Region region) {
  const std::vector<Sample> all = samples.of_all(region.faces);
  const std::optional<TwoHeights> two =
      region.faces.size() > 1 ? find_two_heights(all) : std::optional<TwoHeights>{};
  std::vector<Region> result;
  if (two && has_two_heights(all, fit_both(all, middle_of(complex, region)), *two)) {
    Votes votes = count_votes(samples, region, *two);
    const double smaller = std::min(votes.patches[kLow], votes.patches[kHigh]);
    if (smaller >= kFewest && votes.mixed <= kMixed * smaller) {
      settle_open(complex, region, votes.side);
      Region parts[2] = {region, region};
      parts[kLow].faces.clear();
      parts[kHigh].faces.clear();
      for (std::size_t i = 0; i < region.faces.size(); ++i) {
        parts[votes.side[i]].faces.push_back(region.faces[i]);
      }
      for (Region& part : parts) {
        for (Region& piece : split_by_height(complex, samples, std::move(part))) {
          result.push_back(std::move(piece));
        }
      }
      return result;
    }
  }
  result.push_back(std::move(region));
  return result;
}

}  // namespace roomcut::fit_surfaces
