// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/artefact/provenance.h"
#include "stages/ingest/fixed_grid.h"
#include "stages/ingest/scan_reader.h"

namespace roomcut::ingest {

/// How a scan's coordinates become local ones: unit, up axis, origin; and the part of space that is looked
/// at.
struct ScanFrame {
  Frame frame;
  double metres = 1;                 ///< metres per unit of the file
  std::array<int, 3> axis{0, 1, 2};  ///< which axis of the file becomes x, y, z
  std::array<double, 3> sign{1, 1, 1};
  std::array<std::int32_t, 3> window{
      0, 0, 0};  ///< lower corner of the window in tile edges; points outside are ghosts

  Eigen::Matrix3d level = Eigen::Matrix3d::Identity();  ///< level_turn() of the frame

  /// Metres, z up, before the origin is subtracted.
  Vec3 turned(const Vec3& file) const;
  /// Local coordinates.
  Vec3 local(const Vec3& file) const {
    return level * (turned(file) - Vec3(frame.origin[0], frame.origin[1], frame.origin[2]));
  }
};

/// Local points; normals turned the same way. Points that are not finite, or beyond the window, are not in
/// it.
struct LocalPoints {
  std::vector<float> x, y, z;
  std::vector<float> nx, ny, nz;  ///< empty when there are none
  std::uint64_t not_finite = 0;
  std::uint64_t far = 0;  ///< outside the window
};

/// Metres in a unit m, mm, cm or ft. Errors: std::invalid_argument for other words.
double metres_of(const std::string& unit);

/// Unit m, mm, cm or ft; up axis x, y, z, -x, -y, -z: the axes are turned, never mirrored; y up becomes (x,
/// -z, y). The origin is `middle` (scan_middle(), in the file's unit and axes), to a micrometre: every grid
/// of every stage begins at the local origin, so that the building lies on it in the same way wherever the
/// file's own origin is, and float32 keeps 0.1 mm up to 1 km from it. The window is centred on it.
/// `up_in_scan`: the unit vector that is to be z (Frame::level). Errors: std::invalid_argument for other
/// words.
ScanFrame choose_frame(const Vec3& middle, const std::string& unit, const std::string& up,
                       const std::array<double, 3>& up_in_scan = {0, 0, 1});

/// Converts a block. Keeps the order. `local` is overwritten, its capacity used again.
void to_local(const ScanBlock& block, const ScanFrame& frame, const UnitScale& scale, LocalPoints& local);

}  // namespace roomcut::ingest
