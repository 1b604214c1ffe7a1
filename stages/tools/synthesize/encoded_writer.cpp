// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <array>
#include <span>
#include <system_error>

#include "common/artefact/atomic_file.h"
#include "common/child_process/child_process.h"
#include "common/errors/codes.h"
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
      : file_(path),
        process_(command_of(path, encoder, option, encoders, file_.temporary_path()),
                 ChildProcess::Stream::kInput) {}

  void begin(const ScannerPose* pose) override {
    if (pose == nullptr) return record('S', {});
    const Eigen::Quaterniond turn(pose->rotation);
    const std::array<double, 7> numbers{turn.w(),           turn.x(),           turn.y(),          turn.z(),
                                        pose->position.x(), pose->position.y(), pose->position.z()};
    record('S', std::as_bytes(std::span(numbers)));
  }

  void add(std::span<const float> xyz) override { record('P', std::as_bytes(xyz)); }

  void finish() override {
    record('E', {});
    end();
    file_.commit();
  }

 private:
  void record(char kind, std::span<const std::byte> data) {
    const std::uint64_t bytes = data.size();
    if (!process_.write(std::as_bytes(std::span(&kind, 1))) ||
        !process_.write(std::as_bytes(std::span(&bytes, 1))) || !process_.write(data)) {
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
  ChildProcess process_;
};

}  // namespace

std::unique_ptr<ScanWriter> make_encoded_writer(const std::filesystem::path& path, const std::string& encoder,
                                                const std::string& option,
                                                const std::filesystem::path& encoders) {
  return std::make_unique<EncodedWriter>(path, encoder, option, encoders);
}

}  // namespace roomcut::synthesize
