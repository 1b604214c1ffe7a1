// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/slices/slices_io.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "common/artefact/h5_values.h"
#include "common/artefact/limits.h"
#include "common/artefact/types.h"
#include "common/slices/planes_io.h"

namespace roomcut {
namespace {

constexpr double kLargestShare = 1.001;  ///< with room for rounding

template <class T, class Field>
std::vector<T> column(const std::vector<Level>& levels, Field field) {
  std::vector<T> values;
  values.reserve(levels.size());
  for (const Level& level : levels) values.push_back(static_cast<T>(level.*field));
  return values;
}

/// The slices' values one after the other, as the file holds them.
template <class T>
std::vector<T> joined(const std::vector<OccupancyGrid>& grids, std::vector<T> OccupancyGrid::*field) {
  std::vector<T> values;
  for (const OccupancyGrid& grid : grids) {
    values.insert(values.end(), (grid.*field).begin(), (grid.*field).end());
  }
  return values;
}

void write_scalar(H5Writer& file, const std::string& path, double value, const char* unit,
                  const char* description) {
  file.write(path, std::vector<double>{value}, unit, description);
}

void write_levels(H5Writer& file, const std::vector<Level>& levels) {
  file.write("levels/z", column<double>(levels, &Level::z), "m", "height: area-weighted mean of the band");
  file.write("levels/lo", column<double>(levels, &Level::lo), "m",
             "lower end of the horizontal structure slice");
  file.write("levels/hi", column<double>(levels, &Level::hi), "m",
             "upper end of the horizontal structure slice");
  file.write("levels/area", column<double>(levels, &Level::area_m2), "m^2", "horizontal surface in the band");
  file.write("levels/component", column<double>(levels, &Level::component_m2), "m^2",
             "footprint of the largest connected component in the band");
  file.write("levels/cap", column<std::uint8_t>(levels, &Level::cap), "1",
             "1 = no surface was seen here, walls end");
  file.write("levels/step", column<std::uint8_t>(levels, &Level::step), "1",
             "1 = one of several levels that stand for a slope");
}

void write_wall_slices(H5Writer& file, const std::vector<OccupancyGrid>& grids) {
  std::vector<std::uint64_t> offset{0};
  for (const OccupancyGrid& grid : grids) offset.push_back(offset.back() + grid.size());
  file.write("wall_slices/offset", offset, "1",
             "first cell of wall slice k, which lies between levels k and k+1");
  file.write("wall_slices/ix", joined(grids, &OccupancyGrid::ix), "1", "cell column: floor(x / tau)");
  file.write("wall_slices/iy", joined(grids, &OccupancyGrid::iy), "1", "cell row: floor(y / tau)");
  file.write("wall_slices/x", joined(grids, &OccupancyGrid::x), "m", "centroid of the cell's points");
  file.write("wall_slices/y", joined(grids, &OccupancyGrid::y), "m", "centroid of the cell's points");
  file.write("wall_slices/coverage", joined(grids, &OccupancyGrid::coverage), "1",
             "occupied share of the evidence height, corrected for density");
  file.write("wall_slices/weight", joined(grids, &OccupancyGrid::weight_m), "m",
             "length of wall the cell speaks for");
  file.write("wall_slices/area", joined(grids, &OccupancyGrid::area_m2), "m^2",
             "surface that the cell's points stand for");
  file.write("wall_slices/azimuth", joined(grids, &OccupancyGrid::azimuth), "1",
             "mean direction of the wall points' normals: theta = (value + 1/2) * pi / 256");
  file.write("wall_slices/azimuth_trust", joined(grids, &OccupancyGrid::azimuth_trust), "1",
             "0 = no wall points, 255 = all points agree on the azimuth");
}

std::vector<Level> read_levels(const H5Reader& file) {
  using limits::kFarthest_m;
  const auto heights = [&file](const char* path, std::uint64_t n) {
    return read_in_range<double>(file, path, {n}, -kFarthest_m, kFarthest_m);
  };
  const auto areas = [&file](const char* path, std::uint64_t n) {
    return read_in_range<double>(file, path, {n}, 0, limits::kLargestArea_m2);
  };
  const auto z = heights("levels/z", 0);
  const std::uint64_t n = z.size();
  if (n < 2) file.damaged("levels/z", "has fewer than two levels");
  const auto lo = heights("levels/lo", n);
  const auto hi = heights("levels/hi", n);
  const auto area = areas("levels/area", n);
  const auto component = areas("levels/component", n);
  const auto cap = read_in_range<std::uint8_t>(file, "levels/cap", {n}, 0, 1);
  const auto step = read_in_range<std::uint8_t>(file, "levels/step", {n}, 0, 1);
  std::vector<Level> levels(n);
  for (std::size_t i = 0; i < n; ++i) {
    levels[i] = {z[i], lo[i], hi[i], area[i], component[i], cap[i] != 0, step[i] != 0};
    if (i > 0 && z[i] <= z[i - 1]) file.damaged("levels/z", "is not ascending");
    if (lo[i] > hi[i]) file.damaged("levels/lo", "lies above levels/hi");
  }
  return levels;
}

template <class T>
void split(const H5Reader& file, const std::string& path, const std::vector<std::uint64_t>& offset,
           std::vector<OccupancyGrid>& grids, std::vector<T> OccupancyGrid::*field,
           double low = std::numeric_limits<T>::lowest(), double high = std::numeric_limits<T>::max()) {
  const std::vector<T> values = read_in_range<T>(file, path, {offset.back()}, low, high);
  for (std::size_t k = 0; k < grids.size(); ++k) {
    (grids[k].*field)
        .assign(values.begin() + static_cast<std::ptrdiff_t>(offset[k]),
                values.begin() + static_cast<std::ptrdiff_t>(offset[k + 1]));
  }
}

/// Cells index rows of memory, so they must be in order, in the box, and hold their centroid.
void check_cells(const H5Reader& file, const Slices& slices) {
  constexpr double kSlack_m = 1e-4;  // of a centroid that was rounded to float32 …
  constexpr double kSlack = 1e-6;    // … far from the origin
  const auto index = [&slices](double m) { return std::floor(m / slices.tau_m); };
  const auto in_cell = [&](double m, std::int32_t cell) {
    const double off = std::abs(m - (cell + 0.5) * slices.tau_m);
    return off <= 0.5 * slices.tau_m + kSlack_m + kSlack * std::abs(m);
  };
  const auto in_box = [&](std::int32_t cell, int axis) {
    return cell >= index(slices.bbox_min[axis]) - 1 && cell <= index(slices.bbox_max[axis]) + 1;
  };
  for (const OccupancyGrid& grid : slices.wall_slices) {
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (i > 0 && std::pair(grid.iy[i], grid.ix[i]) <= std::pair(grid.iy[i - 1], grid.ix[i - 1])) {
        file.damaged("wall_slices/iy", "the cells are not sorted by (iy, ix)");
      }
      if (!in_box(grid.ix[i], 0)) file.damaged("wall_slices/ix", "a cell lies outside the scan's box");
      if (!in_box(grid.iy[i], 1)) file.damaged("wall_slices/iy", "a cell lies outside the scan's box");
      if (!in_cell(grid.x[i], grid.ix[i])) file.damaged("wall_slices/x", "a centroid is not in its cell");
      if (!in_cell(grid.y[i], grid.iy[i])) file.damaged("wall_slices/y", "a centroid is not in its cell");
    }
  }
}

void read_wall_slices(const H5Reader& file, Slices& slices) {
  std::vector<OccupancyGrid>& grids = slices.wall_slices;
  const auto offset = file.read<std::uint64_t>("wall_slices/offset", {grids.size() + 1});
  if (offset.front() != 0 || !std::is_sorted(offset.begin(), offset.end())) {
    file.damaged("wall_slices/offset", "is not ascending from 0");
  }
  split(file, "wall_slices/ix", offset, grids, &OccupancyGrid::ix);
  split(file, "wall_slices/iy", offset, grids, &OccupancyGrid::iy);
  split(file, "wall_slices/x", offset, grids, &OccupancyGrid::x);
  split(file, "wall_slices/y", offset, grids, &OccupancyGrid::y);
  split(file, "wall_slices/coverage", offset, grids, &OccupancyGrid::coverage, 0, kLargestShare);
  split(file, "wall_slices/weight", offset, grids, &OccupancyGrid::weight_m, 0, limits::kLargestEdge_m);
  split(file, "wall_slices/area", offset, grids, &OccupancyGrid::area_m2, 0, limits::kLargestArea_m2);
  split(file, "wall_slices/azimuth", offset, grids, &OccupancyGrid::azimuth);
  split(file, "wall_slices/azimuth_trust", offset, grids, &OccupancyGrid::azimuth_trust);
  check_cells(file, slices);
}

}  // namespace

Slices read_slices(const std::filesystem::path& path, bool grids) {
  using limits::kFarthest_m;
  const H5Reader file(path, artefacts::kSlices);
  Slices slices;
  slices.frame = file.frame();
  read_box(file, "bbox_min", "bbox_max", slices.bbox_min, slices.bbox_max);
  slices.noise_m = read_number(file, "noise", 0, limits::kLargestNoise_m);
  slices.density = read_number(file, "density", 0, limits::kDensest);
  slices.tau_m = read_number(file, "tau", limits::kSmallestEdge_m, limits::kLargestEdge_m);
  slices.step_m = file.exists("step") ? read_number(file, "step", 0, limits::kLargestEdge_m) : 0;
  slices.histogram.z0 = read_number(file, "histogram/z0", -kFarthest_m, kFarthest_m);
  slices.histogram.bin_m = read_number(file, "histogram/bin", 0, limits::kLargestEdge_m);
  slices.histogram.area_m2 = read_in_range<double>(file, "histogram/area", {0}, 0, limits::kLargestArea_m2);
  slices.levels = read_levels(file);
  slices.planes = read_planes(file);
  slices.wall_slices.resize(slices.levels.size() - 1);
  if (grids) read_wall_slices(file, slices);
  return slices;
}

bool write_slices(const std::filesystem::path& path, const Slices& slices, const Provenance& provenance) {
  H5Writer file(path, artefacts::kSlices, provenance, slices.frame);
  const auto corner = [](const Vec3& p) { return std::vector<double>{p.x(), p.y(), p.z()}; };
  file.write("bbox_min", corner(slices.bbox_min), "m", "smallest coordinates of the kept points");
  file.write("bbox_max", corner(slices.bbox_max), "m", "largest coordinates of the kept points");
  write_scalar(file, "noise", slices.noise_m, "m", "standard deviation of points off their plane");
  write_scalar(file, "density", slices.density, "1/m^2", "points per square metre of surface, median");
  write_scalar(file, "tau", slices.tau_m, "m", "edge of the occupancy cells");
  write_scalar(file, "step", slices.step_m, "m", "distance of the levels that stand for slopes; 0 = none");
  write_scalar(file, "histogram/z0", slices.histogram.z0, "m", "lower edge of bin 0");
  write_scalar(file, "histogram/bin", slices.histogram.bin_m, "m", "height of a bin");
  file.write("histogram/area", slices.histogram.area_m2, "m^2", "horizontal surface per bin");
  write_levels(file, slices.levels);
  write_wall_slices(file, slices.wall_slices);
  write_planes(file, slices.planes);
  return file.commit();
}

}  // namespace roomcut
