// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/extract/unknown_spaces.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "common/cells/cell_pieces.h"
#include "common/cells/plan_walk.h"

namespace roomcut::extract {

namespace {

constexpr double kClosed = 0.7;    // windows and doors leave so much of a room
constexpr double kThickest = 0.6;  // [m] of the walls behind which rooms are named

CellPieces unknown_pieces(const CellComplex& complex, const Labels& labels, const FaceWeights& weights) {
  return connected_pieces(
      complex, [&](std::size_t cell) { return is_unknown(labels.label, cell); },
      [&](const Interface& face) {
        return face.wall ? !weights.is_wall(face.index) : !weights.is_level(face.index);
      });
}

void add_evidence(const CellComplex& complex, const CellPieces& pieces, const DataTerms& terms,
                  std::vector<UnknownSpace>& spaces) {
  std::vector<double> largest(spaces.size(), 0);
  for (std::size_t cell = 0; cell < complex.cells(); ++cell) {
    if (pieces.of_cell[cell] < 0) {
      continue;
    }
    const auto piece = static_cast<std::size_t>(pieces.of_cell[cell]);
    UnknownSpace& space = spaces[piece];
    const double share = complex.volume(cell) / space.measures.volume_m3;
    space.seen_inside += share * terms.seen_inside(cell);
    space.closed += share * terms.closed[cell];
    space.probability += share * terms.beta[cell];
    if (share > largest[piece]) {  // the middle of the largest cell lies in the space, that of an L need not
      largest[piece] = share;
      space.place = complex.centroid(complex.face_of(cell));
    }
  }
}

/// Walks from every wall face of the spaces straight outwards to the next room.
void find_neighbours(const CellComplex& complex, const CellPieces& pieces, const CellRooms& rooms,
                     std::vector<UnknownSpace>& spaces) {
  std::vector<std::map<std::int32_t, double>> shared(spaces.size());
  const auto value = [&](const std::vector<std::int32_t>& of_cell, std::int32_t face, std::size_t layer) {
    return face < 0 ? -1 : of_cell[complex.cell(static_cast<std::size_t>(face), layer)];
  };
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const CellComplex::Edge& edge = complex.edges[e];
    for (const bool to_left : {true, false}) {
      const std::int32_t inside = to_left ? edge.right : edge.left;
      const std::int32_t outside = to_left ? edge.left : edge.right;
      for (std::size_t layer = 0; layer < complex.layers(); ++layer) {
        const std::int32_t piece = value(pieces.of_cell, inside, layer);
        if (piece < 0 || value(pieces.of_cell, outside, layer) == piece) {
          continue;
        }
        std::int32_t room = value(rooms.room, outside, layer);
        walk_beside(complex, e, to_left, kThickest, [&](std::size_t other, bool from_left) {
          const CellComplex::Edge& o = complex.edges[other];
          room = room >= 0 ? room : value(rooms.room, from_left ? o.right : o.left, layer);
        });
        if (room >= 0) {
          shared[static_cast<std::size_t>(piece)][room] += complex.length(e) * complex.height(layer);
        }
      }
    }
  }
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    for (const auto& [room, area] : shared[i]) {
      spaces[i].beside.push_back({room, area});
    }
    std::stable_sort(spaces[i].beside.begin(), spaces[i].beside.end(),
                     [](const SharedWall& a, const SharedWall& b) { return a.area_m2 > b.area_m2; });
  }
}

}  // namespace

bool UnknownSpace::is_closed() const {
  return closed >= kClosed;
}

UnknownSpaces find_unknown_spaces(const CellComplex& complex, const Labels& labels,
                                  const FaceWeights& weights, const DataTerms& terms, const CellRooms& rooms,
                                  const std::vector<Space>& storeys, const StoreyParams& params) {
  const CellPieces pieces = unknown_pieces(complex, labels, weights);
  const std::vector<Space> measures = measure_pieces(EndHeights(complex), labels, pieces);
  std::vector<double> floors;
  for (const Space& storey : storeys) {
    floors.push_back(storey.floor_z);
  }
  std::vector<UnknownSpace> found(measures.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i].measures = measures[i];
    found[i].measures.storey =
        storey_of_run(floors, measures[i].floor_z, measures[i].ceiling_z, params.least_gap_m);
  }
  add_evidence(complex, pieces, terms, found);
  find_neighbours(complex, pieces, rooms, found);

  std::vector<std::size_t> order(found.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) {
    const Space& a = found[i].measures;
    const Space& b = found[k].measures;
    return a.storey != b.storey ? a.storey < b.storey : a.volume_m3 > b.volume_m3;
  });
  UnknownSpaces result;
  std::vector<std::int32_t> number(found.size());
  for (const std::size_t i : order) {
    number[i] = static_cast<std::int32_t>(result.spaces.size());
    result.spaces.push_back(std::move(found[i]));
  }
  for (const std::int32_t piece : pieces.of_cell) {
    result.of_cell.push_back(piece < 0 ? -1 : number[static_cast<std::size_t>(piece)]);
  }
  return result;
}

}  // namespace roomcut::extract
