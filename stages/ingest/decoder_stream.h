// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/child_process/child_process.h"
#include "stages/ingest/scan_reader.h"

namespace roomcut::ingest {

/// How a decoder writes its points (decoders/point_stream.py).
enum class PointForm : std::uint64_t {
  kDoubles = 0,      ///< x, y, z as float64
  kScaled = 1,       ///< x, y, z as int32: coordinate = number · scale + offset
  kWithNormals = 2,  ///< x, y, z as float64, the normal as float32
};

std::size_t bytes_per_point(PointForm form);

/// What a decoder says before its points.
struct StreamHead {
  std::uint64_t most_points = 0;  ///< those that the file promises; some of them may be none
  PointForm form = PointForm::kDoubles;
  std::array<double, 3> scale{1, 1, 1}, offset{0, 0, 0};
};

/// The records of a decoder.
class DecoderStream {
 public:
  /// Starts the decoder. `file` is the scan's name for messages. Errors: std::system_error.
  DecoderStream(std::string file, const std::vector<std::string>& command);

  /// Reads up to the head. Errors: the decoder's own (kScanUnreadable, kScanTruncated, kScanNoPoints,
  /// kScanFormat), kScanFormat when it does not come so far.
  void read_head();
  using TakeBytes = std::function<void(std::span<const std::byte>)>;
  /// Reads the rest; the bytes of the points go to `take`, at most a MiB at a time. Errors: likewise;
  /// kScanFormat when it does not come to its end.
  void read_points(const TakeBytes& take);
  /// Ends the decoder; from any thread.
  void stop() const { process_.stop(); }

  const StreamHead& head() const { return head_; }
  const std::string& file() const { return file_; }
  const std::vector<Vec3>& stations() const { return stations_; }
  /// With read_points() some may be added.
  const std::vector<std::string>& notes() const { return notes_; }
  /// After read_points().
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// The coordinate system as the file states it; empty when it does not.
  const std::string& crs() const { return crs_; }
  const DroppedPoints& dropped() const { return dropped_; }

 private:
  /// Reads one record; false: it is none, or the last one.
  bool next(const TakeBytes& take);
  bool take_record(char kind, std::uint64_t size, const TakeBytes& take);
  bool take_head(std::uint64_t size);
  bool copy_points(std::uint64_t size, const TakeBytes& take);
  bool take_text(char kind, std::uint64_t size);
  template <class T, std::size_t kCount>
  bool numbers(std::array<T, kCount>& values, std::uint64_t size);
  [[noreturn]] void fail(const std::string& text) const;
  [[noreturn]] void came_to_no_end();

  std::string file_;
  ChildProcess process_;
  StreamHead head_;
  std::vector<Vec3> stations_;
  std::vector<std::string> notes_, warnings_;
  std::string crs_;
  DroppedPoints dropped_;
  std::vector<std::byte> buffer_;
  std::uint64_t point_bytes_ = 0;
  bool begun_ = false;
  bool ended_ = false;
};

}  // namespace roomcut::ingest
