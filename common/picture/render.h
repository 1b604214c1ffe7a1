// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "common/picture/image.h"

namespace roomcut {

/// What render() draws: triangles with one colour each, and points. Coordinates in metres, z up.
struct Drawing {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<Colour> triangle_colours;  ///< parallel to triangles
  std::vector<Eigen::Vector3d> points;
  std::vector<Colour> point_colours;  ///< parallel to points
};

/// A parallel projection: seen from the direction `azimuth` (0 = from +x, counter-clockwise) and `elevation`
/// above the horizon [rad]; pi/2 is a plan with +y up when azimuth is -pi/2.
struct View {
  double azimuth = -0.9;
  double elevation = 0.9;
  int width = 1200, height = 900;
  /// Draw only the triangles whose normal points away from the eye. With normals that point out of the rooms
  /// into the walls this looks into the rooms from outside (a doll's house), without taking the roof off.
  bool look_inside = true;
  bool edges = true;    ///< draw the edges where two differently oriented triangles meet
  bool shade = true;    ///< darken triangles by their orientation
  double z_max = 1e30;  ///< points above are left out [m]
  int point_size = 1;   ///< pixels
  bool smooth =
      true;  ///< draw at double size and halve: for edges; points gain nothing and cost four times as much
};

/// Depth-buffered picture, fitted to the drawing. Deterministic.
Image render(const Drawing& drawing, const View& view);

}  // namespace roomcut
