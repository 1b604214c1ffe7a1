// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/voxels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace roomcut::slice {
namespace {

constexpr double kEdge_m = 0.3;
constexpr double kLengthUnit = 0x1.0p-14;  // m; squares of a voxel's edge stay far below 2^63
constexpr double kAreaUnit = 0x1.0p-30;    // m^2

Moments to_moments(const CellEntry<VoxelSum>& entry, const VoxelSize& size) {
  const VoxelSum& sum = entry.sum;
  const double n = static_cast<double>(sum.count);
  const auto mean = [n](std::int64_t value, double unit) { return static_cast<double>(value) * unit / n; };
  const Vec3 corner(entry.key.ix * size.plan_m, entry.key.iy * size.plan_m, entry.key.iz * size.height_m);
  const Vec3 u(mean(sum.x, kLengthUnit), mean(sum.y, kLengthUnit), mean(sum.z, kLengthUnit));
  constexpr double kSquare = kLengthUnit * kLengthUnit;
  Eigen::Matrix3d squares;
  squares << mean(sum.xx, kSquare), mean(sum.xy, kSquare), mean(sum.xz, kSquare), mean(sum.xy, kSquare),
      mean(sum.yy, kSquare), mean(sum.yz, kSquare), mean(sum.xz, kSquare), mean(sum.yz, kSquare),
      mean(sum.zz, kSquare);
  Moments moments;
  moments.area_m2 = static_cast<double>(sum.area) * kAreaUnit;
  const Vec3 p = corner + u;
  moments.first = moments.area_m2 * p;
  moments.second = moments.area_m2 * (squares - u * u.transpose() + p * p.transpose());
  return moments;
}

}  // namespace

VoxelSize voxel_size(double raster_m) {
  const double plan = raster_m * std::max(1.0, std::round(kEdge_m / raster_m));
  return {plan, 0.5 * plan, 1 / plan, 2 / plan};
}

VoxelSum& VoxelSum::operator+=(const VoxelSum& other) {
  count += other.count;
  area += other.area;
  x += other.x;
  y += other.y;
  z += other.z;
  xx += other.xx;
  xy += other.xy;
  xz += other.xz;
  yy += other.yy;
  yz += other.yz;
  zz += other.zz;
  return *this;
}

void add_to_voxel(CellTable<VoxelSum>& table, const VoxelSize& size, const Vec3& point, double area_m2) {
  const CellKey key = size.at(point);
  const std::int64_t x = to_units(point.x() - key.ix * size.plan_m, kLengthUnit);
  const std::int64_t y = to_units(point.y() - key.iy * size.plan_m, kLengthUnit);
  const std::int64_t z = to_units(point.z() - key.iz * size.height_m, kLengthUnit);
  VoxelSum& sum = table.at(key);
  ++sum.count;
  sum.area += to_units(area_m2, kAreaUnit);
  sum.x += x;
  sum.y += y;
  sum.z += z;
  sum.xx += x * x;
  sum.xy += x * y;
  sum.xz += x * z;
  sum.yy += y * y;
  sum.yz += y * z;
  sum.zz += z * z;
}

std::vector<SurfaceVoxel> to_voxels(const std::vector<CellEntry<VoxelSum>>& entries, const VoxelSize& size) {
  std::vector<SurfaceVoxel> voxels;
  voxels.reserve(entries.size());
  for (const CellEntry<VoxelSum>& entry : entries) {
    if (entry.sum.area == 0) continue;
    voxels.push_back({entry.key, static_cast<std::int32_t>(entry.sum.count), to_moments(entry, size)});
  }
  return voxels;
}

VoxelGraph voxel_graph(const std::vector<SurfaceVoxel>& voxels, const std::vector<std::uint8_t>& without) {
  constexpr std::size_t kPart = 4096;
  std::vector<VoxelGraph> parts((voxels.size() + kPart - 1) / kPart);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t p) {
    for (std::size_t i = p * kPart; i < std::min((p + 1) * kPart, voxels.size()); ++i) {
      parts[p].first.push_back(static_cast<std::uint32_t>(parts[p].neighbours.size()));
      if (without[i] != 0) continue;
      for_each_near(voxels, voxels[i].key, 1, 1, [&](std::size_t j) {
        if (j != i) parts[p].neighbours.push_back(static_cast<std::uint32_t>(j));
      });
    }
  });
  VoxelGraph graph;
  graph.first.reserve(voxels.size() + 1);
  for (VoxelGraph& part : parts) {
    const auto before = static_cast<std::uint32_t>(graph.neighbours.size());
    for (const std::uint32_t first : part.first) graph.first.push_back(before + first);
    graph.neighbours.insert(graph.neighbours.end(), part.neighbours.begin(), part.neighbours.end());
    part = {};
  }
  graph.first.push_back(static_cast<std::uint32_t>(graph.neighbours.size()));
  return graph;
}

}  // namespace roomcut::slice
