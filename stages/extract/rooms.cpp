// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/rooms.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace roomcut::extract {

namespace {

/// Floors or ceilings of a space that lie in one plane.
struct Part {
  double area = 0;
  double moment = 0;  ///< area times height at its middle
};

/// The floors or the ceilings of a space, by plane.
class Ends {
 public:
  void add(const EndHeights& heights, std::size_t face, const RunEnd& end) {
    const CellComplex& complex = heights.complex();
    const double area = complex.area(face);
    Part& part = by_plane_[{end.surface, end.surface < 0 ? end.level : -1}];
    part.area += area;
    part.moment += area * heights.z(end, complex.centroid(face));
    for (const Vec2& p : complex.corners(face)) {
      lowest_ = std::min(lowest_, heights.z(end, p));
      highest_ = std::max(highest_, heights.z(end, p));
    }
  }

  /// Height of the largest one, at its middle.
  double largest(const std::vector<double>& levels) const {
    const auto best = std::max_element(by_plane_.begin(), by_plane_.end(), [](const auto& a, const auto& b) {
      return a.second.area < b.second.area;
    });
    if (best == by_plane_.end()) {
      return 0;
    }
    const auto [surface, level] = best->first;
    return surface < 0 ? levels[static_cast<std::size_t>(level)] : best->second.moment / best->second.area;
  }
  double lowest() const { return by_plane_.empty() ? 0 : lowest_; }
  double highest() const { return by_plane_.empty() ? 0 : highest_; }

 private:
  std::map<std::pair<std::int32_t, std::int32_t>, Part> by_plane_;  ///< surface, or -1 and level
  double lowest_ = std::numeric_limits<double>::infinity();
  double highest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

std::vector<Space> measure_pieces(const EndHeights& heights, const Labels& labels, const CellPieces& pieces) {
  const CellComplex& complex = heights.complex();
  const auto count = static_cast<std::size_t>(pieces.count);
  std::vector<Space> spaces(count);
  std::vector<Ends> floors(count), ceilings(count);
  std::vector<std::int32_t> last_face(count, -1);
  for_each_stack(complex, pieces.of_cell, [&](std::size_t face, std::size_t first, std::size_t last) {
    const auto group = static_cast<std::size_t>(pieces.of_cell[complex.cell(face, first)]);
    Space& space = spaces[group];
    const double area = complex.area(face);
    const RunEnd lower = heights.end(face, first);
    const RunEnd upper = heights.end(face, last);
    floors[group].add(heights, face, lower);
    ceilings[group].add(heights, face, upper);
    space.volume_m3 += volume_between(heights, face, lower, upper);
    if (last_face[group] != static_cast<std::int32_t>(face)) {  // a gallery over the same plan counts once
      last_face[group] = static_cast<std::int32_t>(face);
      space.area_m2 += area;
      space.centre += area * complex.centroid(face);
    }
    for (std::size_t k = first; k < last; ++k) {
      if (labels.unobserved[complex.cell(face, k)] != 0) {
        space.unobserved_m3 += area * complex.height(k);
      }
    }
  });
  for (std::size_t g = 0; g < count; ++g) {
    spaces[g].floor_z = floors[g].largest(complex.levels);
    spaces[g].ceiling_z = ceilings[g].largest(complex.levels);
    spaces[g].lowest_ceiling_z = ceilings[g].lowest();
    spaces[g].highest_ceiling_z = ceilings[g].highest();
    if (spaces[g].area_m2 > 0) {
      spaces[g].centre /= spaces[g].area_m2;
    }
  }
  return spaces;
}

Rooms find_rooms(const EndHeights& heights, const Labels& labels, const Storeys& storeys) {
  const CellComplex& complex = heights.complex();
  const CellPieces groups = connected_pieces(
      complex, [&](std::size_t cell) { return is_empty(labels.label, cell); },
      [&](const Interface& face) {
        return storeys.of_cell[static_cast<std::size_t>(face.a)] ==
               storeys.of_cell[static_cast<std::size_t>(face.b)];
      });
  std::vector<Space> spaces = measure_pieces(heights, labels, groups);
  for (std::size_t cell = 0; cell < complex.cells(); ++cell) {
    if (groups.of_cell[cell] >= 0) {
      spaces[static_cast<std::size_t>(groups.of_cell[cell])].storey = storeys.of_cell[cell];
    }
  }
  std::vector<std::int32_t> order(spaces.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t i, std::int32_t k) {
    const Space& a = spaces[static_cast<std::size_t>(i)];
    const Space& b = spaces[static_cast<std::size_t>(k)];
    return a.storey != b.storey ? a.storey < b.storey : a.volume_m3 > b.volume_m3;
  });
  Rooms rooms;
  std::vector<std::int32_t> room_of(spaces.size());
  for (const std::int32_t group : order) {
    room_of[static_cast<std::size_t>(group)] = static_cast<std::int32_t>(rooms.spaces.size());
    rooms.spaces.push_back(spaces[static_cast<std::size_t>(group)]);
  }
  for (const std::int32_t group : groups.of_cell) {
    rooms.of_cell.push_back(group < 0 ? -1 : room_of[static_cast<std::size_t>(group)]);
  }
  return rooms;
}

std::vector<Space> measure_storeys(const EndHeights& heights, const Labels& labels, const Storeys& storeys) {
  CellPieces groups;
  groups.of_cell.assign(storeys.of_cell.begin(), storeys.of_cell.end());
  groups.count = static_cast<std::int32_t>(storeys.floor_z.size());
  std::vector<Space> spaces = measure_pieces(heights, labels, groups);
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    spaces[i].storey = static_cast<int>(i);
  }
  return spaces;
}

}  // namespace roomcut::extract
