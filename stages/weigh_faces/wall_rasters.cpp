// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/wall_rasters.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace roomcut {
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
      plus_(bins_),
      minus_(bins_),
      plus_level_(columns_ * complex.levels.size()),
      minus_level_(columns_ * complex.levels.size()) {}

std::vector<WallRasters::Raster> WallRasters::lay_out() {
  std::vector<std::vector<double>> breaks(complex_.lines.size());
  for (const CellComplex::Edge& e : complex_.edges) {
    if (e.line >= 0) {
      const auto line = static_cast<std::size_t>(e.line);
      for (const std::int32_t v : {e.v0, e.v1}) {
        breaks[line].push_back(
            complex_.lines[line].line.along(complex_.vertices[static_cast<std::size_t>(v)]));
      }
    }
  }
  const auto blocks_z = static_cast<std::size_t>((rows_.bins() + kBlockEdge - 1) / kBlockEdge);
  std::vector<Raster> rasters(complex_.lines.size());
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

void WallRasters::add(SparseCounts& counts, std::int32_t line, double t, double z) {
  const Raster& raster = rasters_[static_cast<std::size_t>(line)];
  const int column = raster.columns.find(t);
  const int row = rows_.find(z);
  if (column >= 0 && row >= 0) {
    counts.add(bin_index(raster, column, row));
  }
}

void WallRasters::add_level_beside(std::int32_t line, bool plus, double t, std::size_t level) {
  const Raster& raster = rasters_[static_cast<std::size_t>(line)];
  const int column = raster.columns.find(t);
  if (column >= 0) {
    (plus ? plus_level_ : minus_level_)
        .add((raster.first_column + static_cast<std::size_t>(column)) * complex_.levels.size() + level);
  }
}

AreaTable WallRasters::column_table(const SparseCounts& counts, const Raster& raster,
                                    std::size_t level) const {
  const int columns = raster.columns.bins();
  std::vector<float> seen(static_cast<std::size_t>(columns));
  for (int c = 0; c < columns; ++c) {
    const std::size_t i =
        (raster.first_column + static_cast<std::size_t>(c)) * complex_.levels.size() + level;
    seen[static_cast<std::size_t>(c)] = counts.at(i) > 0 ? 1.0F : 0.0F;
  }
  return {seen, columns, 1};
}

WallRasters::Tables WallRasters::tables_of(const Raster& raster) const {
  const int columns = raster.columns.bins();
  const int rows = rows_.bins();
  const auto size = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  std::vector<float> area(size);
  std::vector<float> points(size);
  std::vector<float> plus(size);
  std::vector<float> minus(size);
  std::size_t i = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column, ++i) {
      const std::size_t bin = bin_index(raster, column, row);
      area[i] = static_cast<float>(raster.columns.length(column) * rows_.length(row));
      points[i] = static_cast<float>(on_.at(bin));
      plus[i] = plus_.at(bin) > 0 ? 1.0F : 0.0F;
      minus[i] = minus_.at(bin) > 0 ? 1.0F : 0.0F;
    }
  }
  Tables tables;
  tables.area = AreaTable(area, columns, rows);
  tables.points = AreaTable(points, columns, rows);
  tables.plus = AreaTable(plus, columns, rows);
  tables.minus = AreaTable(minus, columns, rows);
  std::vector<float> covered(size, 0.0F);
  const std::vector<float> density = local_density(points, area, columns, rows);
  for (i = 0; i < size; ++i) {
    covered[i] = points[i] > 0 ? static_cast<float>(area[i] * occupancy_weight(density[i], area[i])) : 0.0F;
  }
  tables.covered = AreaTable(covered, columns, rows);
  for (std::size_t level = 0; level < complex_.levels.size(); ++level) {
    tables.plus_level.push_back(column_table(plus_level_, raster, level));
    tables.minus_level.push_back(column_table(minus_level_, raster, level));
  }
  return tables;
}

double WallRasters::omega_of(Divisions::Range columns, std::size_t layer, const Tables& tables) const {
  constexpr double kTopNeeds = 1.0;  // [m] a layer at least this high may count by its top share
  const Divisions::Range rows =
      rows_.interval_of(0.5 * (complex_.levels[layer] + complex_.levels[layer + 1]));
  const auto share = [&](int first_row) {
    const double area = tables.area.bins(columns.begin, columns.end, first_row, rows.end);
    return area > 0 ? tables.covered.bins(columns.begin, columns.end, first_row, rows.end) / area : 0.0;
  };
  double omega = share(rows.begin);
  const int top_rows = static_cast<int>(std::lround(tolerances_.top_share * (rows.end - rows.begin)));
  if (complex_.height(layer) >= kTopNeeds && top_rows > 0) {
    omega = std::max(omega, share(rows.end - top_rows));
  }
  return std::clamp(omega, 0.0, 1.0);
}

double WallRasters::plus_score(Divisions::Range columns, std::size_t layer, const Tables& tables,
                               const std::vector<double>& omega) const {
  constexpr double kSeen = 0.15;      // share of columns with floor or ceiling beside the wall: enough to ask
  constexpr double kContinues = 0.3;  // coverage with which a wall goes on into the next layer
  const auto level_score = [&](std::size_t level, double& score) {
    const double plus = tables.plus_level[level].bins(columns.begin, columns.end, 0, 1);
    const double minus = tables.minus_level[level].bins(columns.begin, columns.end, 0, 1);
    const double count = columns.end - columns.begin;
    score = (plus - minus) / (plus + minus + 0.1 * count);
    return plus + minus > kSeen * count;
  };
  // The nearest floor or ceiling that reaches the wall, below and above, as far as the wall goes on.
  double below = 0;
  for (std::size_t l = layer; !level_score(l, below) && l > 0 && omega[l - 1] > kContinues; --l) {
  }
  double above = 0;
  for (std::size_t l = layer + 1; !level_score(l, above) && l < complex_.layers() && omega[l] > kContinues;
       ++l) {
  }
  const Divisions::Range rows =
      rows_.interval_of(0.5 * (complex_.levels[layer] + complex_.levels[layer + 1]));
  const double plus = tables.plus.bins(columns.begin, columns.end, rows.begin, rows.end);
  const double minus = tables.minus.bins(columns.begin, columns.end, rows.begin, rows.end);
  return 3 * below + 3 * above + 1.5 * (plus - minus) / (plus + minus + 2);
}

void WallRasters::weigh_edge(std::size_t edge, const Raster& raster, const Tables& tables,
                             FaceWeights& weights) const {
  const CellComplex::Edge& e = complex_.edges[edge];
  const CellComplex::Line& line = complex_.lines[static_cast<std::size_t>(e.line)];
  const double t0 = line.line.along(complex_.vertices[static_cast<std::size_t>(e.v0)]);
  const double t1 = line.line.along(complex_.vertices[static_cast<std::size_t>(e.v1)]);
  const Divisions::Range columns = raster.columns.interval_of(0.5 * (t0 + t1));
  const std::size_t layers = complex_.layers();
  std::vector<double> omega(layers);
  for (std::size_t k = 0; k < layers; ++k) {
    omega[k] = omega_of(columns, k, tables);
  }
  // Left of v0 -> v1 is the minus side when the edge runs along the line's direction.
  const bool left_is_plus = t1 < t0;
  for (std::size_t k = 0; k < layers; ++k) {
    const double p_plus = 1 / (1 + std::exp(-1.2 * plus_score(columns, k, tables, omega)));
    const Divisions::Range rows = rows_.interval_of(0.5 * (complex_.levels[k] + complex_.levels[k + 1]));
    const std::size_t face = complex_.wall_face(edge, k);
    weights.wall_omega[face] = static_cast<float>(omega[k]);
    weights.wall_left[face] = static_cast<float>(omega[k] * (left_is_plus ? p_plus : 1 - p_plus));
    weights.wall_right[face] = static_cast<float>(omega[k] * (left_is_plus ? 1 - p_plus : p_plus));
    weights.wall_points[face] = static_cast<std::uint32_t>(
        std::lround(tables.points.bins(columns.begin, columns.end, rows.begin, rows.end)));
  }
}

void WallRasters::weigh(FaceWeights& weights) const {
  const std::size_t faces = complex_.edges.size() * complex_.layers();
  weights.wall_omega.assign(faces, 0);
  weights.wall_left.assign(faces, 0);
  weights.wall_right.assign(faces, 0);
  weights.wall_points.assign(faces, 0);
  std::vector<std::vector<std::size_t>> edges_of(rasters_.size());
  for (std::size_t e = 0; e < complex_.edges.size(); ++e) {
    if (complex_.edges[e].line >= 0) {
      edges_of[static_cast<std::size_t>(complex_.edges[e].line)].push_back(e);
    }
  }
  tbb::parallel_for(std::size_t{0}, rasters_.size(), [&](std::size_t line) {
    if (rasters_[line].columns.bins() > 0) {
      const Tables tables = tables_of(rasters_[line]);
      for (const std::size_t edge : edges_of[line]) {
        weigh_edge(edge, rasters_[line], tables, weights);
      }
    }
  });
}

}  // namespace roomcut
