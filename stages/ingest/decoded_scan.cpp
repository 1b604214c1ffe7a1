// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/decoded_scan.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <system_error>

#include "common/errors/codes.h"
#include "stages/ingest/decoder_process.h"
#include "stages/ingest/scan_records.h"
#include "stages/ingest/spooled_bytes.h"

namespace roomcut {

namespace {

constexpr std::size_t kCopied = 1 << 20;
constexpr std::size_t kLongestText = 1 << 16;
constexpr std::size_t kPointBytes = 3 * sizeof(double);

/// What a decoder said; decoders/point_stream.py describes the records.
class Stream {
 public:
  Stream(const ScanFile& file, DecoderProcess& process, SpooledBytes& points)
      : file_(file), process_(process), points_(points) {}

  /// Reads all records. Errors: the decoder's own, kScanFormat when it does not come to its end.
  void read() {
    std::byte kind{};
    std::uint64_t size = 0;
    while (!ended_ && process_.read({&kind, 1}) == 1 &&
           process_.read(std::as_writable_bytes(std::span(&size, 1))) == sizeof size &&
           take(static_cast<char>(kind), size)) {
    }
    if (const std::string how = process_.finish(); !ended_ || !how.empty()) {
      throw StageError(errors::kScanFormat, file_.name(),
                       "its decoder did not come to the end; it " + (how.empty() ? "stopped" : how),
                       "the file is probably damaged: copy or export it again");
    }
  }

  std::vector<Vec3> stations;
  std::vector<std::string> notes, warnings;
  DroppedPoints dropped;

 private:
  bool take(char kind, std::uint64_t size) {
    switch (kind) {
      case 'P':
        return copy_points(size);
      case 'S': {
        std::array<double, 3> place{};
        stations.emplace_back();
        const bool whole = numbers(place, size);
        stations.back() = Vec3(place[0], place[1], place[2]);
        return whole;
      }
      case 'D': {
        std::array<std::uint64_t, 2> counts{};
        const bool whole = numbers(counts, size);
        dropped = {counts[0], counts[1]};
        return whole;
      }
      case 'E': {
        std::array<std::uint64_t, 1> total{};
        ended_ = numbers(total, size) && total[0] * kPointBytes == points_.size();
        return ended_;
      }
      default:
        return take_text(kind, size);
    }
  }

  bool copy_points(std::uint64_t size) {
    buffer_.resize(kCopied);
    while (size > 0) {
      const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(size, kCopied));
      if (process_.read({buffer_.data(), wanted}) < wanted) {
        return false;
      }
      points_.append({buffer_.data(), wanted});
      size -= wanted;
    }
    return true;
  }

  template <class T, std::size_t kCount>
  bool numbers(std::array<T, kCount>& values, std::uint64_t size) {
    return size == sizeof values && process_.read(std::as_writable_bytes(std::span(values))) == sizeof values;
  }

  bool take_text(char kind, std::uint64_t size) {
    std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(size, kLongestText)), '\0');
    if (size > kLongestText || process_.read(std::as_writable_bytes(std::span(text))) < text.size()) {
      return false;
    }
    if (kind == 'X') {
      fail(text);
    }
    (kind == 'N' ? notes : warnings).push_back(text);
    return kind == 'N' || kind == 'W';
  }

  [[noreturn]] void fail(const std::string& text) const {
    const std::size_t first = text.find('\n');
    const std::size_t second = text.find('\n', first + 1);
    const std::string code = text.substr(0, first);
    for (const ErrorCode& known :
         {errors::kScanUnreadable, errors::kScanTruncated, errors::kScanNoPoints, errors::kScanFormat}) {
      if (code == known.id || known.id == errors::kScanFormat.id) {
        throw StageError(known, file_.name(), text.substr(first + 1, second - first - 1),
                         text.substr(second + 1));
      }
    }
    throw std::logic_error("the list ends with kScanFormat");
  }

  const ScanFile& file_;
  DecoderProcess& process_;
  SpooledBytes& points_;
  std::vector<std::byte> buffer_;
  bool ended_ = false;
};

RecordLayout layout_of(std::uint64_t points) {
  RecordLayout layout;
  layout.count = points;
  for (std::size_t i = 0; i < 3; ++i) {
    layout.columns[i] = {i * sizeof(double), kPointBytes, ScalarType::kFloat64};
  }
  return layout;
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
  DecoderProcess process(
      {python.string(), "-Es", program.string(), std::filesystem::absolute(file.path()).string()});
  const auto points = std::make_shared<SpooledBytes>(file.name(), options.scratch_folder);
  Stream stream(file, process, *points);
  stream.read();
  std::unique_ptr<ScanReader> reader =
      record_reader(points, layout_of(points->size() / kPointBytes), stream.stations);
  reader->drop(stream.dropped);
  for (const std::string& note : stream.notes) {
    reader->note(note);
  }
  for (const std::string& warning : stream.warnings) {
    reader->warn(warning);
  }
  return reader;
}

}  // namespace roomcut
