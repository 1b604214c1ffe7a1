// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "common/picture/image.h"

namespace roomcut {

/// Some rows of a depth-buffered picture, few enough to stay in the processor's cache while they are drawn:
/// a whole picture with its depths would go through memory several times. Coordinates are those of the
/// picture: x right, y down [pixels], z towards the eye; what lies outside the rows is left out. Of what is
/// equally near the first stays.
class DepthBand {
 public:
  DepthBand(int width, int most_rows);

  /// Empties it for the rows [first, first + rows), at most `most_rows`.
  void begin(int first, int rows);

  void triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, Colour colour);
  /// Two pixels wide.
  void line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, Colour colour);
  /// Facing the eye, with (x, y) as its upper left corner.
  void square(int x, int y, int size, double z, Colour colour);

  /// Row y of the picture.
  const Colour* row(int y) const { return image_.row(y - first_); }

 private:
  void fill_row(int first, int last, int y, double z, double z_per_x, Colour colour);
  static std::pair<int, int> inside_row(const std::array<Eigen::Vector3d, 3>& corners, int y, int x0, int x1);

  Image image_;
  std::vector<float> depth_;
  int first_ = 0, end_ = 0;
};

}  // namespace roomcut
