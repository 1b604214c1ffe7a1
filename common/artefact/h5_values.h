// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/artefact/h5.h"
#include "common/artefact/limits.h"

/// Datasets read with the range of their values: what a file says is not used as a length, an index or a
/// number to compute with before. All throw kArtefactDamaged naming the dataset.
namespace roomcut {

/// Checks that all values lie in [low, high]; NaN never does.
template <class T>
void check_range(const H5Reader& file, const std::string& path, const std::vector<T>& values, double low,
                 double high) {
  for (const T value : values) {
    if (!(static_cast<double>(value) >= low && static_cast<double>(value) <= high)) {
      file.damaged(path, "a value is not finite or out of range");
    }
  }
}

template <class T>
std::vector<T> read_in_range(const H5Reader& file, const std::string& path, const h5::Shape& shape,
                             double low, double high) {
  std::vector<T> values = file.read<T>(path, shape);
  check_range(file, path, values, low, high);
  return values;
}

/// A dataset of one number.
inline double read_number(const H5Reader& file, const std::string& path, double low, double high) {
  return read_in_range<double>(file, path, {1}, low, high).front();
}

/// The corners of a box: lower ones below upper ones, of a size that a building can have. `Corner` has three
/// coordinates.
template <class Corner>
void read_box(const H5Reader& file, const std::string& low_path, const std::string& high_path, Corner& low,
              Corner& high) {
  const auto corner = [&file](const std::string& path) {
    return read_in_range<double>(file, path, {3}, -limits::kFarthest_m, limits::kFarthest_m);
  };
  const std::vector<double> lows = corner(low_path);
  const std::vector<double> highs = corner(high_path);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (lows[i] > highs[i] || highs[i] - lows[i] > limits::kLargestExtent_m) {
      file.damaged(low_path, "the box is turned round, or impossibly large");
    }
    low[axis] = lows[i];
    high[axis] = highs[i];
  }
}

}  // namespace roomcut
