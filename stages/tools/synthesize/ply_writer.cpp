// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/output_file.h"
#include "stages/tools/synthesize/scan_writer.h"

namespace roomcut::synthesize {

namespace {

/// Always of the same length for one scene: the number of points is known only at the end.
std::string ply_header(const Scene& scene, std::uint64_t points) {
  const std::string count = std::to_string(points);
  return "ply\nformat binary_little_endian 1.0\ncomment synthetic scan of scene " + scene.name + ", noise " +
         shortest(scene.noise_m) + " m, seed " + std::to_string(scene.seed) +
         std::string(20 - count.size(), ' ') + "\nelement vertex " + count +
         "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
}

/// Binary little-endian PLY, float x, y, z.
class PlyWriter : public ScanWriter {
 public:
  PlyWriter(const std::filesystem::path& path, const Scene& scene) : file_(path), scene_(scene) {
    file_.write(ply_header(scene_, 0));
  }
  void begin(const ScannerPose* /*pose*/) override {}
  void add(std::span<const float> xyz) override {
    file_.write(xyz.data(), xyz.size_bytes());
    points_ += xyz.size() / 3;
  }
  void finish() override {
    file_.overwrite(0, ply_header(scene_, points_));
    file_.commit();
  }

 private:
  OutputFile file_;
  const Scene& scene_;
  std::uint64_t points_ = 0;
};

}  // namespace

std::unique_ptr<ScanWriter> make_ply_writer(const std::filesystem::path& path, const Scene& scene) {
  return std::make_unique<PlyWriter>(path, scene);
}

}  // namespace roomcut::synthesize
