// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/scan_writer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <numbers>

#include "common/errors/codes.h"
#include "stages/tools/synthesize/random_draws.h"

namespace roomcut::synthesize {

namespace {

constexpr std::uint64_t kStream = 0x706f7365;
constexpr double kMostTilt = 2 * std::numbers::pi / 180;  // of a tripod that was set up by eye [rad]

}  // namespace

ScannerPose pose_of(const Scene& scene, std::uint64_t number, const Vec3& station) {
  PointDraws draws(scene.seed, kStream, number);
  const double heading = 2 * std::numbers::pi * draws.unit();
  const double across = 2 * std::numbers::pi * draws.unit();
  const Eigen::AngleAxisd tilt(kMostTilt * draws.unit(), Vec3(std::cos(across), std::sin(across), 0));
  return {(tilt * Eigen::AngleAxisd(heading, Vec3::UnitZ())).toRotationMatrix(), station};
}

std::unique_ptr<ScanWriter> make_scan_writer(const std::filesystem::path& path, const Scene& scene,
                                             const ScanFormat& format) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (ending == ".ply" || ending.empty()) return make_ply_writer(path, scene);
  if (ending == ".ptx") return make_ptx_writer(path);
  if (ending == ".e57")
    return make_encoded_writer(path, "e57", format.spherical ? "spherical" : "cartesian", format.encoders);
  if (ending == ".las" || ending == ".laz")
    return make_encoded_writer(path, "las", ending.substr(1), format.encoders);
  throw StageError(errors::kUsage, path.string(), "scans are not written as " + ending,
                   "name it .ply, .ptx, .e57, .las or .laz");
}

}  // namespace roomcut::synthesize
