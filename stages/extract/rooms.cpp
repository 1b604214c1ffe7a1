// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/rooms.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace roomcut::extract {

namespace {

// Group per cell: -1 = solid; groups numbered from 0 by their first cell.
struct Groups {
  std::vector<std::int32_t> of_cell;
  std::int32_t count = 0;
};

std::vector<std::vector<std::int32_t>> neighbours_in_plan(const CellComplex& complex) {
  std::vector<std::vector<std::int32_t>> neighbours(complex.faces());
  for (const CellComplex::Edge& edge : complex.edges) {
    if (edge.left >= 0 && edge.right >= 0) {
      neighbours[static_cast<std::size_t>(edge.left)].push_back(edge.right);
      neighbours[static_cast<std::size_t>(edge.right)].push_back(edge.left);
    }
  }
  return neighbours;
}

Groups connect(const CellComplex& complex, const Labels& labels, const Storeys& storeys) {
  const auto neighbours = neighbours_in_plan(complex);
  Groups groups;
  groups.of_cell.assign(complex.cells(), -1);
  std::vector<std::size_t> open;
  for (std::size_t seed = 0; seed < complex.cells(); ++seed) {
    if (!is_empty(labels.label, seed) || groups.of_cell[seed] >= 0) {
      continue;
    }
    const std::int32_t group = groups.count++;
    const auto reach = [&](std::size_t cell) {
      if (is_empty(labels.label, cell) && groups.of_cell[cell] < 0 &&
          storeys.of_cell[cell] == storeys.of_cell[seed]) {
        groups.of_cell[cell] = group;
        open.push_back(cell);
      }
    };
    reach(seed);
    while (!open.empty()) {
      const std::size_t cell = open.back();
      open.pop_back();
      const std::size_t face = complex.face_of(cell);
      const std::size_t layer = complex.layer_of(cell);
      for (const std::int32_t beside : neighbours[face]) {
        reach(complex.cell(static_cast<std::size_t>(beside), layer));
      }
      if (layer > 0) reach(complex.cell(face, layer - 1));
      if (layer + 1 < complex.layers()) reach(complex.cell(face, layer + 1));
    }
  }
  return groups;
}

double largest(const std::map<std::size_t, double>& area_of_level, const std::vector<double>& levels) {
  const auto best = std::max_element(area_of_level.begin(), area_of_level.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return best == area_of_level.end() ? 0 : levels[best->first];
}

std::vector<Space> measure(const CellComplex& complex, const Labels& labels, const Storeys& storeys,
                           const Groups& groups) {
  const auto count = static_cast<std::size_t>(groups.count);
  std::vector<Space> spaces(count);
  std::vector<std::map<std::size_t, double>> floors(count), ceilings(count);
  std::vector<std::int32_t> last_face(count, -1);
  for_each_run(complex, labels.label, [&](std::size_t face, std::size_t first, std::size_t last) {
    const auto group = static_cast<std::size_t>(groups.of_cell[complex.cell(face, first)]);
    Space& space = spaces[group];
    const double area = complex.area(face);
    space.storey = storeys.of_cell[complex.cell(face, first)];
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

}  // namespace

Rooms find_rooms(const CellComplex& complex, const Labels& labels, const Storeys& storeys) {
  const Groups groups = connect(complex, labels, storeys);
  const std::vector<Space> spaces = measure(complex, labels, storeys, groups);
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
  Groups groups;
  groups.of_cell.assign(storeys.of_cell.begin(), storeys.of_cell.end());
  groups.count = static_cast<std::int32_t>(storeys.floor_z.size());
  return measure(complex, labels, storeys, groups);
}

}  // namespace roomcut::extract
