// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/wall_rasters.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "stages/weigh_faces/wall_sides.h"

namespace roomcut::weigh_faces {
namespace {

constexpr int kBlockEdge = 32;  // 32 × 32 bins are one block of SparseCounts
static_assert(kBlockEdge * kBlockEdge == SparseCounts::kBlock);
constexpr double kSameVertex = 1e-6;  // [m]

}  // namespace

WallRasters::WallRasters(const CellComplex& complex, const Tolerances& tolerances)
    : complex_(complex),
      tolerances_(tolerances),
      rows_(complex.levels, tolerances.bin, tolerances.core_margin),
      rasters_(lay_out()),
      on_(bins_),
      plus_(columns_ * complex.levels.size()),
      minus_(columns_ * complex.levels.size()) {}

std::vector<WallRasters::Raster> WallRasters::lay_out() {
  std::vector<Raster> rasters(complex_.lines.size());
  std::vector<std::vector<double>> breaks(complex_.lines.size());
  for (std::size_t e = 0; e < complex_.edges.size(); ++e) {
    const CellComplex::Edge& edge = complex_.edges[e];
    if (edge.line >= 0) {
      const auto line = static_cast<std::size_t>(edge.line);
      rasters[line].edges.push_back(e);
      for (const std::int32_t v : {edge.v0, edge.v1}) {
        breaks[line].push_back(
            complex_.lines[line].line.along(complex_.vertices[static_cast<std::size_t>(v)]));
      }
    }
  }
  const auto blocks_z = static_cast<std::size_t>((rows_.bins() + kBlockEdge - 1) / kBlockEdge);
  std::size_t block = 0;
  for (std::size_t i = 0; i < rasters.size(); ++i) {
    std::sort(breaks[i].begin(), breaks[i].end());
    const auto same = [](double a, double b) { return b - a < kSameVertex; };
    breaks[i].erase(std::unique(breaks[i].begin(), breaks[i].end(), same), breaks[i].end());
    Raster& r = rasters[i];
    r.columns = Divisions(breaks[i], tolerances_.bin, tolerances_.core_margin);
    r.blocks_t = static_cast<std::size_t>((r.columns.bins() + kBlockEdge - 1) / kBlockEdge);
    r.first_block = block;
    r.first_column = columns_;
    block += r.blocks_t * blocks_z;
    columns_ += static_cast<std::size_t>(r.columns.bins());
  }
  bins_ = block * SparseCounts::kBlock;
  return rasters;
}

std::size_t WallRasters::bin_index(const Raster& raster, int column, int row) const {
  const std::size_t block = raster.first_block +
                            static_cast<std::size_t>(row / kBlockEdge) * raster.blocks_t +
                            static_cast<std::size_t>(column / kBlockEdge);
  return block * SparseCounts::kBlock +
         static_cast<std::size_t>((row % kBlockEdge) * kBlockEdge + column % kBlockEdge);
}

void WallRasters::add_on(std::int32_t line, double t, double z) {
  const Raster& raster = rasters_[static_cast<std::size_t>(line)];
  const int column = raster.columns.find(t);
  const int row = rows_.find(z);
  if (column >= 0 && row >= 0) {
    on_.add(bin_index(raster, column, row));
  }
}

void WallRasters::add_level_beside(std::int32_t line, bool plus, double t, std::size_t level) {
  const Raster& raster = rasters_[static_cast<std::size_t>(line)];
  const int column = raster.columns.find(t);
  if (column >= 0) {
    (plus ? plus_ : minus_)
        .add((raster.first_column + static_cast<std::size_t>(column)) * complex_.levels.size() + level);
  }
}

WallRasters::Tables WallRasters::tables_of(const Raster& raster) const {
  const int columns = raster.columns.bins();
  const int rows = rows_.bins();
  const auto size = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  std::vector<float> area(size);
  std::vector<float> points(size);
  std::size_t i = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column, ++i) {
      area[i] = static_cast<float>(raster.columns.length(column) * rows_.length(row));
      points[i] = static_cast<float>(on_.at(bin_index(raster, column, row)));
    }
  }
  AreaTable area_table(area, columns, rows);
  const std::vector<float> density = local_density(points, area, area_table, columns, rows);
  std::vector<float> covered(size, 0.0F);
  for (i = 0; i < size; ++i) {
    const double weight = tolerances_.correct_density ? occupancy_weight(density[i], area[i]) : 1;
    covered[i] = points[i] > 0 ? static_cast<float>(area[i] * weight) : 0.0F;
  }
  return {std::move(area_table), AreaTable(covered, columns, rows), AreaTable(points, columns, rows)};
}

Divisions::Range WallRasters::columns_of(std::size_t edge, const Raster& raster) const {
  const CellComplex::Edge& e = complex_.edges[edge];
  const Vec2 middle = 0.5 * (complex_.vertices[static_cast<std::size_t>(e.v0)] +
                             complex_.vertices[static_cast<std::size_t>(e.v1)]);
  return raster.columns.interval_of(complex_.lines[static_cast<std::size_t>(e.line)].line.along(middle));
}

Divisions::Range WallRasters::rows_of(std::size_t layer) const {
  return rows_.interval_of(0.5 * (complex_.levels[layer] + complex_.levels[layer + 1]));
}

double WallRasters::omega_of(const Raster& raster, Divisions::Range columns, std::size_t layer,
                             const Tables& tables) const {
  constexpr double kTopNeeds = 1.0;  // [m] a layer at least this high may count by its top share
  const Divisions::Range rows = rows_of(layer);
  if (tolerances_.edge_bins) return occupied_columns(columns, rows, tables);
  const auto share = [&](int first_row) {
    const double area = tables.area.bins(columns.begin, columns.end, first_row, rows.end);
    return area > 0 ? tables.covered.bins(columns.begin, columns.end, first_row, rows.end) / area : 0.0;
  };
  double omega = share(rows.begin);
  const int top_rows = static_cast<int>(std::lround(tolerances_.top_share * (rows.end - rows.begin)));
  if (complex_.height(layer) >= kTopNeeds && top_rows > 0) {
    const double top = share(rows.end - top_rows);
    omega = top > omega && !is_beam(raster, columns, layer, tables) ? top : omega;
  }
  return std::clamp(omega, 0.0, 1.0);
}

/// Furniture that hides the lower part of a wall also hides the floor before it, and no floor goes through a
/// wall: where it is seen on both sides from end to end, on more than a door's width of the line, and nothing
/// hangs as low as a door's head, that is a beam.
bool WallRasters::is_beam(const Raster& raster, Divisions::Range columns, std::size_t layer,
                          const Tables& tables) const {
  constexpr double kEndToEnd = 0.8;
  constexpr double kWidestDoor = 2.0;   // [m]
  constexpr double kHighestDoor = 2.3;  // [m]
  constexpr double kStray = 0.05;       // coverage
  const Divisions::Range rows = rows_of(layer);
  int row = rows.begin;
  double height = 0;
  while (row < rows.end && height < kHighestDoor) height += rows_.length(row++);
  const double below = tables.area.bins(columns.begin, columns.end, rows.begin, row);
  if (height < kHighestDoor ||
      tables.covered.bins(columns.begin, columns.end, rows.begin, row) > kStray * below) {
    return false;
  }
  double passed = 0, length = 0;
  for (int c = columns.begin; c < columns.end; ++c) {
    passed += floor_on_both_sides(raster, c, layer) ? raster.columns.length(c) : 0;
    length += raster.columns.length(c);
  }
  if (passed <= kEndToEnd * length) return false;
  const auto go_on = [&](int c, int step) {
    for (; c >= 0 && c < raster.columns.bins() && passed <= kWidestDoor; c += step) {
      if (!floor_on_both_sides(raster, c, layer)) return;
      passed += raster.columns.length(c);
    }
  };
  go_on(columns.begin - 1, -1);
  go_on(columns.end, +1);
  return passed > kWidestDoor;
}

bool WallRasters::floor_on_both_sides(const Raster& raster, int column, std::size_t layer) const {
  constexpr double kAround = 0.25;  // [m] along the wall: sparse scans have no point in each column
  const int around = static_cast<int>(std::ceil(kAround / tolerances_.bin));
  bool plus = false, minus = false;
  for (int c = std::max(0, column - around); c < std::min(raster.columns.bins(), column + around + 1); ++c) {
    const std::size_t i =
        (raster.first_column + static_cast<std::size_t>(c)) * complex_.levels.size() + layer;
    plus = plus || plus_.at(i) > 0;
    minus = minus || minus_.at(i) > 0;
  }
  return plus && minus;
}

/// The share of the columns that hold a point at any height.
double WallRasters::occupied_columns(Divisions::Range columns, Divisions::Range rows, const Tables& tables) {
  int occupied = 0;
  for (int c = columns.begin; c < columns.end; ++c) {
    occupied += tables.points.bins(c, c + 1, rows.begin, rows.end) > 0 ? 1 : 0;
  }
  return static_cast<double>(occupied) / std::max(1, columns.end - columns.begin);
}

void WallRasters::weigh_coverage(FaceWeights& weights) const {
  const std::size_t faces = complex_.edges.size() * complex_.layers();
  weights.wall_omega.assign(faces, 0);
  weights.wall_points.assign(faces, 0);
  tbb::parallel_for(std::size_t{0}, rasters_.size(), [&](std::size_t line) {
    const Raster& raster = rasters_[line];
    if (raster.edges.empty()) {
      return;
    }
    const Tables tables = tables_of(raster);
    for (const std::size_t edge : raster.edges) {
      const Divisions::Range columns = columns_of(edge, raster);
      for (std::size_t k = 0; k < complex_.layers(); ++k) {
        const Divisions::Range rows = rows_of(k);
        const double points = tables.points.bins(columns.begin, columns.end, rows.begin, rows.end);
        weights.wall_omega[complex_.wall_face(edge, k)] =
            static_cast<float>(omega_of(raster, columns, k, tables));
        weights.wall_points[complex_.wall_face(edge, k)] = static_cast<std::uint32_t>(std::lround(points));
      }
    }
  });
}

double WallRasters::strip(const SparseCounts& counts, const Raster& raster, Divisions::Range columns,
                          std::size_t level) const {
  int seen = 0;
  for (int c = columns.begin; c < columns.end; ++c) {
    const std::size_t i =
        (raster.first_column + static_cast<std::size_t>(c)) * complex_.levels.size() + level;
    seen += counts.at(i) > 0 ? 1 : 0;
  }
  return static_cast<double>(seen) / std::max(1, columns.end - columns.begin);
}

void WallRasters::weigh_sides(FaceWeights& weights) const {
  weights.wall_left.assign(weights.wall_omega.size(), 0);
  weights.wall_right.assign(weights.wall_omega.size(), 0);
  tbb::parallel_for(std::size_t{0}, rasters_.size(), [&](std::size_t line) {
    const Raster& raster = rasters_[line];
    for (const std::size_t edge : raster.edges) {
      const CellComplex::Edge& e = complex_.edges[edge];
      const Vec2 along = complex_.vertices[static_cast<std::size_t>(e.v1)] -
                         complex_.vertices[static_cast<std::size_t>(e.v0)];
      // Left of v0 -> v1 is the minus side when the edge runs along the line's direction.
      const bool left_is_plus = complex_.lines[line].line.direction().dot(along) < 0;
      const Divisions::Range columns = columns_of(edge, raster);
      const FacesBeside left_faces(complex_, edge, true, tolerances_.beside_low);
      const FacesBeside right_faces(complex_, edge, false, tolerances_.beside_low);
      for (std::size_t k = 0; k < complex_.layers(); ++k) {
        StripShares strips;
        for (const std::size_t level : {k, k + 1}) {
          strips.left += 0.5 * strip(left_is_plus ? plus_ : minus_, raster, columns, level);
          strips.right += 0.5 * strip(left_is_plus ? minus_ : plus_, raster, columns, level);
        }
        const double left = left_probability(complex_, weights, edge, k, strips, left_faces, right_faces);
        const std::size_t face = complex_.wall_face(edge, k);
        weights.wall_left[face] = static_cast<float>(weights.wall_omega[face] * left);
        weights.wall_right[face] = static_cast<float>(weights.wall_omega[face] * (1 - left));
      }
    }
  });
}

}  // namespace roomcut::weigh_faces
