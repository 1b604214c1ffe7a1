// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <charconv>

#include "stages/tools/synthesize/output_file.h"
#include "stages/tools/synthesize/scan_writer.h"

namespace roomcut::synthesize {

namespace {

constexpr int kDecimals = 6;  // as scanners' programs write coordinates [m]
constexpr std::size_t kCountWidth = 20;

std::string fixed(double value) {
  std::array<char, 400> text{};
  return {
      text.data(),
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, kDecimals).ptr};
}

std::string line(const Vec3& v, const char* end) {
  return shortest(v.x()) + " " + shortest(v.y()) + " " + shortest(v.z()) + end;
}

/// PTX: per set-up a header with the scanner's position, its axes and the matrix that moves its points, then
/// lines of x, y, z and intensity in the scanner's own coordinates. Points stand in one row.
class PtxWriter : public ScanWriter {
 public:
  explicit PtxWriter(const std::filesystem::path& path) : file_(path) {}

  void begin(const ScannerPose* pose) override {
    end_set_up();
    pose_ = pose != nullptr ? *pose : ScannerPose{Eigen::Matrix3d::Identity(), Vec3::Zero()};
    count_at_ = file_.size();
    points_ = 0;
    begun_ = true;
    std::string header(kCountWidth, ' ');
    header.append("\n1\n").append(line(pose_.position, "\n"));
    for (int axis = 0; axis < 3; ++axis) header += line(pose_.rotation.col(axis), "\n");
    for (int axis = 0; axis < 3; ++axis) header += line(pose_.rotation.col(axis), " 0\n");
    file_.write(header + line(pose_.position, " 1\n"));
  }

  void add(std::span<const float> xyz) override {
    std::string text;
    for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
      const Vec3 own = pose_.rotation.transpose() * (Vec3(xyz[i], xyz[i + 1], xyz[i + 2]) - pose_.position);
      text += fixed(own.x()) + " " + fixed(own.y()) + " " + fixed(own.z()) + " 0.5\n";
    }
    file_.write(text);
    points_ += xyz.size() / 3;
  }

  void finish() override {
    end_set_up();
    file_.commit();
  }

 private:
  /// How many points there are is known only now.
  void end_set_up() {
    if (!begun_) return;
    const std::string count = std::to_string(points_);
    file_.overwrite(count_at_, std::string(kCountWidth - count.size(), ' ') + count);
  }

  OutputFile file_;
  ScannerPose pose_{Eigen::Matrix3d::Identity(), Vec3::Zero()};
  std::uint64_t count_at_ = 0, points_ = 0;
  bool begun_ = false;
};

}  // namespace

std::unique_ptr<ScanWriter> make_ptx_writer(const std::filesystem::path& path) {
  return std::make_unique<PtxWriter>(path);
}

}  // namespace roomcut::synthesize
