// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/decoded_scan.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

#include "common/errors/codes.h"
#include "stages/ingest/decoder_stream.h"
#include "stages/ingest/scratch_file.h"

namespace roomcut::ingest {

namespace {

constexpr std::uint64_t kPointsPerBlock = 1 << 16;

/// Points that a thread of its own takes from the decoder into a scratch file, while others read the blocks
/// that are there already.
class DecodedReader : public ScanReader {
 public:
  DecodedReader(std::unique_ptr<DecoderStream> stream, const std::filesystem::path& scratch_folder)
      : stream_(std::move(stream)),
        point_bytes_(bytes_per_point(stream_->head().form)),
        said_(stream_->notes().size()),
        scratch_(scratch_folder) {
    taking_ = std::thread([this] { take_all(); });
  }
  ~DecodedReader() override {
    stream_->stop();
    taking_.join();
  }
  DecodedReader(const DecodedReader&) = delete;
  DecodedReader& operator=(const DecodedReader&) = delete;

  std::size_t blocks() const override {
    return static_cast<std::size_t>((stream_->head().most_points + kPointsPerBlock - 1) / kPointsPerBlock);
  }
  bool has_normals() const override { return stream_->head().form == PointForm::kWithNormals; }
  const std::vector<Vec3>& stations() const override { return stream_->stations(); }
  const std::string& crs() const override { return stream_->crs(); }
  double resolution(double /*magnitude*/) const override { return 0; }

  /// Waits until the block is there. The last blocks are short or empty where points were dropped.
  void read(std::size_t index, ScanBlock& block) const override {
    thread_local std::vector<std::byte> held;
    const std::uint64_t first = index * kPointsPerBlock * point_bytes_;
    const std::uint64_t there = wait_for(first + kPointsPerBlock * point_bytes_);
    held.resize(static_cast<std::size_t>(
        std::min(kPointsPerBlock * point_bytes_, there > first ? there - first : 0)));
    if (!held.empty()) {
      scratch_.read(first, held);
    }
    block.resize(held.size() / point_bytes_, has_normals());
    if (stream_->head().form == PointForm::kScaled) {
      scale(held, block);
    } else {
      copy(held, block);
    }
  }

  /// Only here it is known that the decoder came to its end.
  void check_total(std::uint64_t /*points*/) const override { wait_for(~std::uint64_t{0}); }
  DroppedPoints dropped() const override { return stream_->dropped(); }
  std::vector<std::string> late_warnings() const override { return stream_->warnings(); }
  std::vector<std::string> late_notes() const override {
    return {stream_->notes().begin() + static_cast<std::ptrdiff_t>(said_), stream_->notes().end()};
  }

 private:
  void take_all() {
    std::exception_ptr error;
    try {
      stream_->read_points([this](std::span<const std::byte> bytes) {
        scratch_.write(there_, bytes);
        const std::scoped_lock lock(mutex_);
        there_ += bytes.size();
        more_.notify_all();
      });
    } catch (...) {
      error = std::current_exception();
    }
    const std::scoped_lock lock(mutex_);
    error_ = error;
    ended_ = true;
    more_.notify_all();
  }

  /// Bytes that are there: `wanted` at least, or all. Errors: what ended the decoding.
  std::uint64_t wait_for(std::uint64_t wanted) const {
    std::unique_lock lock(mutex_);
    more_.wait(lock, [&] { return ended_ || there_ >= wanted; });
    if (error_ && there_ < wanted) {
      std::rethrow_exception(error_);
    }
    return there_;
  }

  void scale(const std::vector<std::byte>& held, ScanBlock& block) const {
    const std::array<double*, 3> axes{block.x.data(), block.y.data(), block.z.data()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double step = stream_->head().scale[axis];
      const double offset = stream_->head().offset[axis];
      for (std::size_t i = 0; i < block.size(); ++i) {
        std::int32_t number = 0;
        std::memcpy(&number, held.data() + i * point_bytes_ + axis * sizeof number, sizeof number);
        axes[axis][i] = number * step + offset;
      }
    }
  }

  void copy(const std::vector<std::byte>& held, ScanBlock& block) const {
    const std::array<double*, 3> axes{block.x.data(), block.y.data(), block.z.data()};
    const std::array<float*, 3> normals{block.nx.data(), block.ny.data(), block.nz.data()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < block.size(); ++i) {
        const std::byte* point = held.data() + i * point_bytes_;
        std::memcpy(axes[axis] + i, point + axis * sizeof(double), sizeof(double));
        if (has_normals()) {
          std::memcpy(normals[axis] + i, point + 3 * sizeof(double) + axis * sizeof(float), sizeof(float));
        }
      }
    }
  }

  std::unique_ptr<DecoderStream> stream_;
  std::size_t point_bytes_;
  std::size_t said_;  ///< of the notes: those before the points
  ScratchFile scratch_;
  mutable std::mutex mutex_;
  mutable std::condition_variable more_;
  std::uint64_t there_ = 0;  ///< bytes in the scratch file
  bool ended_ = false;
  std::exception_ptr error_;
  std::thread taking_;
};

/// Of a real scan a point takes three bytes at least; a damaged count would keep the decoder busy for ever.
void check_promise(const ScanFile& file, std::uint64_t points) {
  if (points / 8 > file.size()) {
    throw StageError(errors::kScanTruncated, file.name(),
                     "its headers promise " + std::to_string(points) + " points, more than " +
                         std::to_string(file.size()) + " bytes can hold",
                     "copy the scan again; if that does not help, export it again");
  }
}

}  // namespace

const char* decoder_of(std::string_view head) {
  return head.starts_with("ASTM-E57") ? "e57" : head.starts_with("LASF") ? "las" : nullptr;
}

std::unique_ptr<ScanReader> open_decoded(const ScanFile& file, const std::string& decoder,
                                         const ScanOptions& options) {
  const std::filesystem::path python = options.decoders / "python" / "bin" / "python3";
  const std::filesystem::path program = options.decoders / "decoders" / (decoder + ".py");
  std::error_code ignored;
  if (!std::filesystem::exists(python, ignored) || !std::filesystem::exists(program, ignored)) {
    throw StageError(
        errors::kScanNoDecoder, file.name(),
        std::string("this is ") + (decoder == "e57" ? "an E57" : "a LAS or LAZ") +
            " file; the Python environment that reads it is not there (" + python.string() + ")",
        "run make deps where the package registry can be reached, or convert the scan to PLY or text, "
        "e.g. with CloudCompare or PDAL");
  }
  auto stream = std::make_unique<DecoderStream>(
      file.name(), std::vector<std::string>{python.string(), "-Es", program.string(),
                                            std::filesystem::absolute(file.path()).string()});
  stream->read_head();
  check_promise(file, stream->head().most_points);
  const std::vector<std::string> notes = stream->notes();
  auto reader = std::make_unique<DecodedReader>(std::move(stream), options.scratch_folder);
  for (const std::string& note : notes) {
    reader->note(note);
  }
  return reader;
}

}  // namespace roomcut::ingest
