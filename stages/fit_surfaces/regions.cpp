// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/fit_surfaces/regions.h"

#include <algorithm>
#include <map>
#include <utility>

namespace roomcut::fit_surfaces {
namespace {

/// Calls visit(neighbour level face) for those beside a level face that are the surface's, with the same
/// empty side.
template <class Visit>
void for_each_beside(const CellComplex& complex, const Seats& seats, const std::vector<std::size_t>& chosen,
                     std::size_t level_face, Visit&& visit) {
  const std::size_t face = complex.face_of_level(level_face);
  const std::size_t level = complex.level_of(level_face);
  for (const std::int32_t e : complex.edges_of(face)) {
    const std::int32_t beside =
        complex.edges[static_cast<std::size_t>(e)].across(static_cast<std::int32_t>(face));
    if (beside < 0) {
      continue;
    }
    const std::size_t other = complex.level_face(static_cast<std::size_t>(beside), level);
    if (chosen[other] < seats.size() && seats[chosen[other]].ceiling == seats[chosen[level_face]].ceiling) {
      visit(other, complex.length(static_cast<std::size_t>(e)));
    }
  }
}

/// Seats of one level face: those of its plan face with its level.
std::vector<std::size_t> seats_of(const CellComplex& complex, const Seats& seats, std::size_t level_face) {
  std::vector<std::size_t> result;
  const std::size_t face = complex.face_of_level(level_face);
  for (std::size_t i = seats.first(face); i < seats.first(face + 1); ++i) {
    if (static_cast<std::size_t>(seats[i].level) == complex.level_of(level_face)) {
      result.push_back(i);
    }
  }
  return result;
}

/// The seat with the plane that most of the border to decided neighbours has; size() = there are none.
std::size_t as_neighbours(const CellComplex& complex, const Seats& seats,
                          const std::vector<std::size_t>& chosen, const std::vector<bool>& decided,
                          std::size_t level_face) {
  std::map<std::int32_t, double> border;
  for_each_beside(complex, seats, chosen, level_face, [&](std::size_t other, double length) {
    if (decided[other]) {
      border[seats[chosen[other]].plane] += length;
    }
  });
  std::size_t best = seats.size();
  double most = 0;
  for (const std::size_t i : seats_of(complex, seats, level_face)) {
    const auto found = border.find(seats[i].plane);
    if (found != border.end() && found->second > most) {
      most = found->second;
      best = i;
    }
  }
  return best;
}

}  // namespace

std::vector<std::size_t> choose_seats(const CellComplex& complex, const Seats& seats,
                                      const std::vector<Observation>& observations) {
  std::vector<std::uint64_t> points(seats.size(), 0);
  for (const Observation& o : observations) {
    points[o.seat] += o.points;
  }
  std::vector<std::size_t> chosen(complex.faces() * complex.levels.size(), seats.size());
  std::vector<bool> decided(chosen.size(), false);
  std::vector<std::size_t> open;
  for (std::size_t face = 0; face < complex.faces(); ++face) {
    for (std::size_t i = seats.first(face); i < seats.first(face + 1); ++i) {
      const std::size_t at = complex.level_face(face, static_cast<std::size_t>(seats[i].level));
      if (chosen[at] == seats.size() || points[i] > points[chosen[at]]) {
        chosen[at] = i;
      }
    }
  }
  for (std::size_t at = 0; at < chosen.size(); ++at) {
    if (chosen[at] < seats.size()) {
      decided[at] = points[chosen[at]] > 0 || seats_of(complex, seats, at).size() == 1;
      if (!decided[at]) {
        open.push_back(at);
      }
    }
  }
  while (!open.empty()) {
    std::vector<std::size_t> left;
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (const std::size_t at : open) {
      const std::size_t seat = as_neighbours(complex, seats, chosen, decided, at);
      if (seat < seats.size()) {
        found.emplace_back(at, seat);
      } else {
        left.push_back(at);
      }
    }
    if (found.empty()) {
      break;
    }
    for (const auto& [at, seat] : found) {
      chosen[at] = seat;
      decided[at] = true;
    }
    open = std::move(left);
  }
  return chosen;
}

std::vector<Region> find_regions(const CellComplex& complex, const Seats& seats,
                                 const std::vector<std::size_t>& chosen) {
  std::vector<Region> regions;
  std::map<std::int32_t, Region> of_plane;
  std::vector<bool> done(chosen.size(), false);
  for (std::size_t at = 0; at < chosen.size(); ++at) {
    if (chosen[at] == seats.size() || done[at]) {
      continue;
    }
    const Seat& seat = seats[chosen[at]];
    if (seat.plane >= 0) {
      Region& region =
          of_plane.try_emplace(seat.plane, Region{seat.level, seat.plane, seat.ceiling, {}}).first->second;
      region.faces.push_back(at);
      continue;
    }
    Region region{seat.level, -1, seat.ceiling, {at}};
    done[at] = true;
    for (std::size_t i = 0; i < region.faces.size(); ++i) {
      for_each_beside(complex, seats, chosen, region.faces[i], [&](std::size_t other, double /*length*/) {
        if (!done[other] && seats[chosen[other]].plane < 0) {
          done[other] = true;
          region.faces.push_back(other);
        }
      });
    }
    std::sort(region.faces.begin(), region.faces.end());
    regions.push_back(std::move(region));
  }
  for (auto& [plane, region] : of_plane) {
    regions.push_back(std::move(region));
  }
  return regions;
}

}  // namespace roomcut::fit_surfaces
