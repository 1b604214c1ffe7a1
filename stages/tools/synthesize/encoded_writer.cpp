// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <array>
#include <system_error>

#include "common/artefact/atomic_file.h"
#include "common/errors/codes.h"
#include "stages/tools/synthesize/encoder_process.h"
#include "stages/tools/synthesize/scan_writer.h"

namespace roomcut::synthesize {

namespace {

std::vector<std::string> command_of(const std::filesystem::path& path, const std::string& encoder,
                                    const std::string& option, const std::filesystem::path& encoders,
                                    const std::filesystem::path& temporary) {
  const std::filesystem::path python = encoders / "python" / "bin" / "python3";
  const std::filesystem::path program = encoders / "encoders" / (encoder + ".py");
  std::error_code ignored;
  if (!std::filesystem::exists(python, ignored) || !std::filesystem::exists(program, ignored)) {
    throw StageError(
        errors::kScanNoDecoder, path.string(),
        "the Python environment that writes E57, LAS and LAZ is not there (" + python.string() + ")",
        "run make deps where the package registry can be reached, or write .ply or .ptx");
  }
  return {python.string(), "-Es", program.string(), std::filesystem::absolute(temporary).string(), option};
}

/// Hands the points to a program, in the records that encoders/scan_records.py describes.
class EncodedWriter : public ScanWriter {
 public:
  EncodedWriter(const std::filesystem::path& path, const std::string& encoder, const std::string& option,
                const std::filesystem::path& encoders)
      : file_(path), process_(command_of(path, encoder, option, encoders, file_.temporary_path())) {}

  void begin(const ScannerPose* pose) override {
    if (pose == nullptr) return record('S', nullptr, 0);
    const Eigen::Quaterniond turn(pose->rotation);
    const std::array<double, 7> numbers{turn.w(),           turn.x(),           turn.y(),          turn.z(),
                                        pose->position.x(), pose->position.y(), pose->position.z()};
    record('S', numbers.data(), sizeof numbers);
  }

  void add(std::span<const float> xyz) override { record('P', xyz.data(), xyz.size_bytes()); }

  void finish() override {
    record('E', nullptr, 0);
    end();
    file_.commit();
  }

 private:
  void record(char kind, const void* data, std::uint64_t bytes) {
    if (!process_.write(&kind, 1) || !process_.write(&bytes, sizeof bytes) || !process_.write(data, bytes)) {
      end();
      cannot_write("its encoder took no more points");
    }
  }
  void end() {
    const std::string how = process_.finish();
    if (!how.empty()) cannot_write("its encoder " + how);
  }
  [[noreturn]] void cannot_write(const std::string& why) const {
    throw StageError(errors::kCannotWrite, file_.final_path().string(), "cannot be written: " + why,
                     "is the disk full?");
  }

  AtomicFile file_;
  EncoderProcess process_;
};

}  // namespace

std::unique_ptr<ScanWriter> make_encoded_writer(const std::filesystem::path& path, const std::string& encoder,
                                                const std::string& option,
                                                const std::filesystem::path& encoders) {
  return std::make_unique<EncodedWriter>(path, encoder, option, encoders);
}

}  // namespace roomcut::synthesize
