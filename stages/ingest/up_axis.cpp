// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/up_axis.h"

#include <algorithm>
#include <cmath>

namespace roomcut::ingest {

namespace {

constexpr int kAlongAxis = 7;       // azimuth steps of 0.7°: within 5°
constexpr double kMoreSurface = 2;  // than the level planes have
constexpr double kLower = 0.7;      // of the scan's shorter other side

std::string rounded(double value) {
  const auto tenths = std::llround(10 * value);
  return std::to_string(tenths / 10) + "." + std::to_string(std::abs(tenths % 10));
}

}  // namespace

void AxisAreas::add(const CloudTile& part) {
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (part.surface[i] == static_cast<std::uint8_t>(SurfaceClass::kHorizontal)) {
      m2_[2] += static_cast<double>(part.area[i]);
    } else if (part.surface[i] == static_cast<std::uint8_t>(SurfaceClass::kWall)) {
      const int azimuth = part.azimuth[i];
      if (azimuth < kAlongAxis || azimuth >= kAzimuthSteps - kAlongAxis) {
        m2_[0] += static_cast<double>(part.area[i]);
      } else if (std::abs(azimuth - kAzimuthSteps / 2) <= kAlongAxis) {
        m2_[1] += static_cast<double>(part.area[i]);
      }
    }
  }
}

std::string upright_floors(const AxisAreas& areas, const Vec3& low, const Vec3& high, const std::string& up) {
  const Vec3 size = high - low;
  for (int axis = 0; axis < 2 && up == "z"; ++axis) {
    const double across = areas.m2()[static_cast<std::size_t>(axis)];
    const double others = std::min(size[2], size[1 - axis]);
    if (size[axis] < kLower * others && across > kMoreSurface * areas.m2()[2]) {
      const std::string name(1, "xy"[axis]);
      return "is " + name + " the up axis? Across it there are " + std::to_string(std::lround(across)) +
             " m^2 of planes, level ones are " + std::to_string(std::lround(areas.m2()[2])) +
             " m^2, and the scan is " + rounded(size[axis]) + " m along " + name + ", " + rounded(size[2]) +
             " m high; then give --up " + name + " (with make: UP=" + name + ")";
    }
  }
  return "";
}

}  // namespace roomcut::ingest
