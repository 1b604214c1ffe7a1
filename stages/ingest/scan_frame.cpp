// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "common/geometry/level_turn.h"

namespace roomcut::ingest {

namespace {

constexpr double kOriginSteps = 1e6;  // per metre

struct Axes {
  std::array<int, 3> axis;
  std::array<double, 3> sign;
};

const Axes& axes_of(const std::string& up) {
  static const std::map<std::string, Axes> kAxes{
      {"z", {{0, 1, 2}, {1, 1, 1}}},   {"-z", {{0, 1, 2}, {1, -1, -1}}}, {"y", {{0, 2, 1}, {1, -1, 1}}},
      {"-y", {{0, 2, 1}, {1, 1, -1}}}, {"x", {{1, 2, 0}, {1, 1, 1}}},    {"-x", {{2, 1, 0}, {1, 1, -1}}}};
  const auto found = kAxes.find(up);
  if (found == kAxes.end()) {
    throw std::invalid_argument("up axis '" + up + "'");
  }
  return found->second;
}

/// One axis of the file, ready to be applied to many points.
struct AxisMap {
  const double* from;
  double factor;
  double origin;
  double operator()(std::size_t i) const { return from[i] * factor - origin; }
};

AxisMap axis_map(const ScanBlock& block, const ScanFrame& frame, std::size_t axis) {
  const std::array<const double*, 3> columns{block.x.data(), block.y.data(), block.z.data()};
  return {columns[static_cast<std::size_t>(frame.axis[axis])], frame.sign[axis] * frame.metres,
          frame.frame.origin[axis]};
}

void copy_normal(const ScanBlock& block, const ScanFrame& frame, std::size_t from, std::size_t to,
                 LocalPoints& local) {
  const std::array<const float*, 3> columns{block.nx.data(), block.ny.data(), block.nz.data()};
  const auto turned = [&](std::size_t axis) {
    return static_cast<float>(frame.sign[axis]) * columns[static_cast<std::size_t>(frame.axis[axis])][from];
  };
  const Eigen::Vector3f level = frame.level.cast<float>() * Eigen::Vector3f(turned(0), turned(1), turned(2));
  local.nx[to] = level.x();
  local.ny[to] = level.y();
  local.nz[to] = level.z();
}

void resize(LocalPoints& local, std::size_t points, bool normals) {
  for (std::vector<float>* axis : {&local.x, &local.y, &local.z}) {
    axis->resize(points);
  }
  for (std::vector<float>* axis : {&local.nx, &local.ny, &local.nz}) {
    axis->resize(normals ? points : 0);
  }
}

}  // namespace

double metres_of(const std::string& unit) {
  static const std::map<std::string, double> kUnits{{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"ft", 0.3048}};
  const auto found = kUnits.find(unit);
  if (found == kUnits.end()) {
    throw std::invalid_argument("unit '" + unit + "'");
  }
  return found->second;
}

Vec3 ScanFrame::turned(const Vec3& file) const {
  return {sign[0] * metres * file[axis[0]], sign[1] * metres * file[axis[1]],
          sign[2] * metres * file[axis[2]]};
}

ScanFrame choose_frame(const Vec3& middle, const std::string& unit, const std::string& up,
                       const std::array<double, 3>& up_in_scan) {
  const Axes& axes = axes_of(up);
  ScanFrame result;
  result.frame.unit = unit;
  result.frame.up = up;
  result.metres = metres_of(unit);
  result.axis = axes.axis;
  result.sign = axes.sign;
  std::copy(up_in_scan.begin(), up_in_scan.end(), result.frame.level);
  result.level = level_turn(result.frame.level);
  const Vec3 origin = result.turned(middle);
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    result.frame.origin[axis] = std::round(origin[k] * kOriginSteps) / kOriginSteps;
    result.window[axis] = -(k < 2 ? fixed_grid::kWindowTiles : fixed_grid::kWindowLayers) / 2;
  }
  return result;
}

void to_local(const ScanBlock& block, const ScanFrame& frame, const UnitScale& scale, LocalPoints& local) {
  const bool normals = !block.nx.empty();
  resize(local, block.size(), normals);
  local.not_finite = 0;
  local.far = 0;
  const AxisMap x = axis_map(block, frame, 0);
  const AxisMap y = axis_map(block, frame, 1);
  const AxisMap z = axis_map(block, frame, 2);
  const bool levelled = frame.frame.levelled();
  const double tile = scale.tile_edge_m();
  std::array<double, 3> low{};
  std::array<double, 3> high{};
  for (std::size_t k = 0; k < 3;
       ++k) {  // half a unit inside, so that rounding to float never leaves the window
    const int tiles = k < 2 ? fixed_grid::kWindowTiles : fixed_grid::kWindowLayers;
    low[k] = frame.window[k] * tile + 0.01;
    high[k] = (frame.window[k] + tiles) * tile - 0.01;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < block.size(); ++i) {
    double px = x(i);
    double py = y(i);
    double pz = z(i);
    if (levelled) {
      const Vec3 level = frame.level * Vec3(px, py, pz);
      px = level.x();
      py = level.y();
      pz = level.z();
    }
    const bool inside =
        px > low[0] && px < high[0] && py > low[1] && py < high[1] && pz > low[2] && pz < high[2];
    if (inside) {
      local.x[kept] = static_cast<float>(px);
      local.y[kept] = static_cast<float>(py);
      local.z[kept] = static_cast<float>(pz);
      if (normals) {
        copy_normal(block, frame, i, kept, local);
      }
      ++kept;
    } else if (std::isfinite(px) && std::isfinite(py) && std::isfinite(pz)) {
      ++local.far;
    } else {
      ++local.not_finite;
    }
  }
  resize(local, kept, normals);
}

}  // namespace roomcut::ingest
