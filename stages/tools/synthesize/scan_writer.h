// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "stages/tools/synthesize/sample.h"

namespace roomcut::synthesize {

/// Where a scanner stood and how it was turned: p = rotation · (the scanner's own coordinates) + position.
struct ScannerPose {
  Eigen::Matrix3d rotation;
  Vec3 position;
};

/// The pose of a set-up: turned about the vertical by any angle and out of it by up to two degrees, as the
/// scene's seed says.
ScannerPose pose_of(const Scene& scene, std::uint64_t number, const Vec3& station);

/// Writes a scan in one format, from front to back; the file gets its name in finish(). All functions throw
/// StageError(kCannotWrite).
class ScanWriter {
 public:
  virtual ~ScanWriter() = default;
  /// The points that follow are of another set-up; no pose: nobody knows where its scanner stood.
  virtual void begin(const ScannerPose* pose) = 0;
  /// x, y, z of some points, in the scene's coordinates [m].
  virtual void add(std::span<const float> xyz) = 0;
  virtual void finish() = 0;
};

/// How a scan is written.
struct ScanFormat {
  bool spherical = false;          ///< E57: range, azimuth, elevation
  std::filesystem::path encoders;  ///< folder with python/ and encoders/ (.ci/install-python.sh)
};

/// The writer for the format that the name's ending says: .ply (also none), .ptx, .e57, .las, .laz, upper
/// case too. Errors: kUsage for another ending, kScanNoDecoder when the format's Python libraries are not
/// there.
std::unique_ptr<ScanWriter> make_scan_writer(const std::filesystem::path& path, const Scene& scene,
                                             const ScanFormat& format);

std::unique_ptr<ScanWriter> make_ply_writer(const std::filesystem::path& path, const Scene& scene);
std::unique_ptr<ScanWriter> make_ptx_writer(const std::filesystem::path& path);
/// By the program encoders/<encoder>.py, called with the file's name and `options`.
std::unique_ptr<ScanWriter> make_encoded_writer(const std::filesystem::path& path, const std::string& encoder,
                                                const std::string& option,
                                                const std::filesystem::path& encoders);

}  // namespace roomcut::synthesize
