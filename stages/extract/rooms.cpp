// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/rooms.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace roomcut::extract {

namespace {

double largest(const std::map<std::size_t, double>& area_of_level, const std::vector<double>& levels) {
  const auto best = std::max_element(area_of_level.begin(), area_of_level.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return best == area_of_level.end() ? 0 : levels[best->first];
}

}  // namespace

std::vector<Space> measure_pieces(const CellComplex& complex, const Labels& labels,
                                  const CellPieces& pieces) {
  const auto count = static_cast<std::size_t>(pieces.count);
  std::vector<Space> spaces(count);
  std::vector<std::map<std::size_t, double>> floors(count), ceilings(count);
  std::vector<std::int32_t> last_face(count, -1);
  for_each_stack(complex, pieces.of_cell, [&](std::size_t face, std::size_t first, std::size_t last) {
    const auto group = static_cast<std::size_t>(pieces.of_cell[complex.cell(face, first)]);
    Space& space = spaces[group];
    const double area = complex.area(face);
    floors[group][first] += area;
    ceilings[group][last] += area;
    space.volume_m3 += area * (complex.levels[last] - complex.levels[first]);
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
    spaces[g].floor_z = largest(floors[g], complex.levels);
    spaces[g].ceiling_z = largest(ceilings[g], complex.levels);
    if (spaces[g].area_m2 > 0) {
      spaces[g].centre /= spaces[g].area_m2;
    }
  }
  return spaces;
}

Rooms find_rooms(const CellComplex& complex, const Labels& labels, const Storeys& storeys) {
  const CellPieces groups = connected_pieces(
      complex, [&](std::size_t cell) { return is_empty(labels.label, cell); },
      [&](const Interface& face) {
        return storeys.of_cell[static_cast<std::size_t>(face.a)] ==
               storeys.of_cell[static_cast<std::size_t>(face.b)];
      });
  std::vector<Space> spaces = measure_pieces(complex, labels, groups);
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

std::vector<Space> measure_storeys(const CellComplex& complex, const Labels& labels, const Storeys& storeys) {
  CellPieces groups;
  groups.of_cell.assign(storeys.of_cell.begin(), storeys.of_cell.end());
  groups.count = static_cast<std::int32_t>(storeys.floor_z.size());
  std::vector<Space> spaces = measure_pieces(complex, labels, groups);
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    spaces[i].storey = static_cast<int>(i);
  }
  return spaces;
}

}  // namespace roomcut::extract
