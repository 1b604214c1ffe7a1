// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/geometry/convex_hull.h"
#include "common/geometry/scan_coordinates.h"
#include "common/sloped_planes/accepted_planes.h"

namespace roomcut {

namespace {

constexpr double kDegToRad = std::numbers::pi / 180.0;

double to_six_decimals(double value) {
  const double result = std::round(value * 1e6) / 1e6;
  return result == 0 ? 0 : result;
}

Vec2 as_in_file(const Vec2& local, const ScanCoordinates& scan) {
  const Vec2 there = scan.plan_to_scan(local);
  const Vec2 rounded(to_six_decimals(there.x()), to_six_decimals(there.y()));
  return without_rounding(scan.plan_to_local(rounded));
}

}  // namespace

Vec2 middle_of(const std::vector<Vec2>& ring) {
  Vec2 sum(0, 0);
  double area = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Vec2 a = ring[i] - ring[0];
    const Vec2 b = ring[i + 1] - ring[0];
    const double part = a.x() * b.y() - a.y() * b.x();
    sum += part * (a + b) / 3;
    area += part;
  }
  return ring[0] + sum / area;
}

PlaneNumbers numbers_of(const SlopedPlane& plane, const Frame& frame) {
  const ScanCoordinates scan(frame);
  const Vec2 uphill = scan.plan_turn() * plane.gradient;
  const Vec2 middle = middle_of(plane.outline);
  PlaneNumbers numbers;
  numbers.pitch_deg = to_six_decimals(std::atan(plane.gradient.norm()) / kDegToRad);
  numbers.uphill_deg = to_six_decimals(std::atan2(uphill.y(), uphill.x()) / kDegToRad);
  if (numbers.uphill_deg < 0) {
    numbers.uphill_deg = to_six_decimals(numbers.uphill_deg + 360);
  }
  numbers.height_m = to_six_decimals(scan.height_to_scan(middle, plane.height(middle)));
  return numbers;
}

SlopedPlane plane_of(std::vector<Vec2> outline, const PlaneNumbers& numbers, const Frame& frame) {
  const ScanCoordinates scan(frame);
  const double angle = numbers.uphill_deg * kDegToRad;
  const Vec2 uphill = (scan.plan_turn().inverse() * Vec2(std::cos(angle), std::sin(angle))).normalized();
  SlopedPlane plane;
  plane.gradient = std::tan(numbers.pitch_deg * kDegToRad) * uphill;
  plane.outline = std::move(outline);
  const Vec2 middle = middle_of(plane.outline);
  plane.c = without_rounding(scan.height_to_local(middle, numbers.height_m)) - plane.gradient.dot(middle);
  plane.area_m2 =
      to_six_decimals(0.5 * turned_area(plane.outline) * std::sqrt(1 + plane.gradient.squaredNorm()));
  return plane;
}

AcceptedPlanes normalised_planes(AcceptedPlanes planes) {
  const ScanCoordinates scan(planes.frame);
  planes.bbox_min = as_in_file(planes.bbox_min, scan);
  planes.bbox_max = as_in_file(planes.bbox_max, scan);
  for (PlaneFeature& feature : planes.planes) {
    SlopedPlane& plane = feature.plane;
    for (Vec2& corner : plane.outline) {
      corner = as_in_file(corner, scan);
    }
    plane.outline = convex_hull(std::move(plane.outline));
    if (plane.outline.size() < 3) {
      continue;
    }
    SlopedPlane rounded = plane_of(plane.outline, numbers_of(plane, planes.frame), planes.frame);
    rounded.area_m2 = to_six_decimals(plane.area_m2);
    rounded.rms_m = to_six_decimals(plane.rms_m);
    rounded.ceiling = plane.ceiling;
    plane = std::move(rounded);
  }
  std::erase_if(planes.planes, [](const PlaneFeature& feature) { return feature.plane.outline.size() < 3; });
  std::sort(planes.planes.begin(), planes.planes.end(),
            [](const PlaneFeature& a, const PlaneFeature& b) { return a.id < b.id; });
  return planes;
}

}  // namespace roomcut
