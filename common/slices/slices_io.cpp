// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/slices/slices_io.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/artefact/h5.h"
#include "common/artefact/types.h"

namespace roomcut {
namespace {

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

double read_scalar(const H5Reader& file, const std::string& path) {
  const double value = file.read<double>(path, {1}).front();
  if (!std::isfinite(value)) file.damaged(path, "is not finite");
  return value;
}

Vec3 read_corner(const H5Reader& file, const std::string& path) {
  const std::vector<double> values = file.read<double>(path, {3});
  return {values[0], values[1], values[2]};
}

std::vector<Level> read_levels(const H5Reader& file) {
  const auto z = file.read<double>("levels/z");
  const std::uint64_t n = z.size();
  if (n < 2) file.damaged("levels/z", "has fewer than two levels");
  const auto lo = file.read<double>("levels/lo", {n});
  const auto hi = file.read<double>("levels/hi", {n});
  const auto area = file.read<double>("levels/area", {n});
  const auto component = file.read<double>("levels/component", {n});
  const auto cap = file.read<std::uint8_t>("levels/cap", {n});
  const auto step = file.read<std::uint8_t>("levels/step", {n});
  std::vector<Level> levels(n);
  for (std::size_t i = 0; i < n; ++i) {
    levels[i] = {z[i], lo[i], hi[i], area[i], component[i], cap[i] != 0, step[i] != 0};
    if (!std::isfinite(z[i]) || (i > 0 && z[i] <= z[i - 1])) file.damaged("levels/z", "is not ascending");
  }
  return levels;
}

template <class T>
void split(const H5Reader& file, const std::string& path, const std::vector<std::uint64_t>& offset,
           std::vector<OccupancyGrid>& grids, std::vector<T> OccupancyGrid::*field) {
  const std::vector<T> values = file.read<T>(path, {offset.back()});
  for (std::size_t k = 0; k < grids.size(); ++k) {
    (grids[k].*field)
        .assign(values.begin() + static_cast<std::ptrdiff_t>(offset[k]),
                values.begin() + static_cast<std::ptrdiff_t>(offset[k + 1]));
  }
}

void read_wall_slices(const H5Reader& file, std::vector<OccupancyGrid>& grids) {
  const auto offset = file.read<std::uint64_t>("wall_slices/offset", {grids.size() + 1});
  if (offset.front() != 0 || !std::is_sorted(offset.begin(), offset.end())) {
    file.damaged("wall_slices/offset", "is not ascending from 0");
  }
  split(file, "wall_slices/ix", offset, grids, &OccupancyGrid::ix);
  split(file, "wall_slices/iy", offset, grids, &OccupancyGrid::iy);
  split(file, "wall_slices/x", offset, grids, &OccupancyGrid::x);
  split(file, "wall_slices/y", offset, grids, &OccupancyGrid::y);
  split(file, "wall_slices/coverage", offset, grids, &OccupancyGrid::coverage);
  split(file, "wall_slices/weight", offset, grids, &OccupancyGrid::weight_m);
  split(file, "wall_slices/area", offset, grids, &OccupancyGrid::area_m2);
  split(file, "wall_slices/azimuth", offset, grids, &OccupancyGrid::azimuth);
  split(file, "wall_slices/azimuth_trust", offset, grids, &OccupancyGrid::azimuth_trust);
}

}  // namespace

Slices read_slices(const std::filesystem::path& path, bool grids) {
  const H5Reader file(path, artefacts::kSlices);
  Slices slices;
  slices.frame = file.frame();
  slices.bbox_min = read_corner(file, "bbox_min");
  slices.bbox_max = read_corner(file, "bbox_max");
  slices.noise_m = read_scalar(file, "noise");
  slices.density = read_scalar(file, "density");
  slices.tau_m = read_scalar(file, "tau");
  if (slices.tau_m <= 0) file.damaged("tau", "is not positive");
  slices.histogram.z0 = read_scalar(file, "histogram/z0");
  slices.histogram.bin_m = read_scalar(file, "histogram/bin");
  slices.histogram.area_m2 = file.read<double>("histogram/area");
  slices.levels = read_levels(file);
  slices.wall_slices.resize(slices.levels.size() - 1);
  if (grids) read_wall_slices(file, slices.wall_slices);
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
  write_scalar(file, "histogram/z0", slices.histogram.z0, "m", "lower edge of bin 0");
  write_scalar(file, "histogram/bin", slices.histogram.bin_m, "m", "height of a bin");
  file.write("histogram/area", slices.histogram.area_m2, "m^2", "horizontal surface per bin");
  write_levels(file, slices.levels);
  write_wall_slices(file, slices.wall_slices);
  return file.commit();
}

}  // namespace roomcut
