// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_text.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <string>

#include "common/errors/codes.h"
#include "stages/ingest/line_parser.h"
#include "stages/ingest/text_lines.h"

namespace roomcut::ingest {

namespace {

constexpr std::uint64_t kBlockBytes = 1 << 21;
constexpr std::size_t kLongestLine = 1 << 20;

class TextReader : public ScanReader {
 public:
  TextReader(std::shared_ptr<const ScanBytes> file, TextLayout layout, std::vector<Vec3> stations)
      : file_(std::move(file)), layout_(std::move(layout)), stations_(std::move(stations)) {
    promised_ = layout_.promised.value_or(0);
  }

  std::size_t blocks() const override {
    return static_cast<std::size_t>((layout_.end - layout_.begin + kBlockBytes - 1) / kBlockBytes);
  }
  bool has_normals() const override { return layout_.normals; }
  const std::vector<Vec3>& stations() const override { return stations_; }
  double resolution(double /*magnitude*/) const override { return 0; }

  void read(std::size_t index, ScanBlock& block) const override {
    thread_local std::vector<char> bytes;
    const std::uint64_t first = load_lines(index, bytes);
    block.resize(0, false);
    LineParser parser(layout_);
    const char* p = bytes.data();
    const char* const end = p + bytes.size();
    while (p < end) {
      const auto* stop = static_cast<const char*>(std::memchr(p, '\n', static_cast<std::size_t>(end - p)));
      stop = stop == nullptr ? end : stop;
      if (parser.parse(p, stop)) {
        append(block, parser.values());
      } else {
        take_other_line(p, stop, first + static_cast<std::uint64_t>(p - bytes.data()));
      }
      p = stop + 1;
    }
  }

  void check_total(std::uint64_t points) const override {
    if (points < promised_) {
      throw StageError(errors::kScanTruncated, file_->name(),
                       "count lines promise " + std::to_string(promised_) + " points, the file holds " +
                           std::to_string(points),
                       "export or copy the scan again");
    }
    if (layout_.promised && points > promised_) {
      throw StageError(errors::kScanTruncated, file_->name(),
                       "count lines promise " + std::to_string(promised_) + " points, the file holds " +
                           std::to_string(points),
                       "correct the count, or remove that line: then all of them are read");
    }
  }

 private:
  /// The whole lines that begin in block `index`; returns the place of the first in the file.
  std::uint64_t load_lines(std::size_t index, std::vector<char>& bytes) const {
    const std::uint64_t begin = layout_.begin + index * kBlockBytes;
    const std::uint64_t end = std::min(layout_.end, begin + kBlockBytes);
    const std::uint64_t from = index == 0 ? begin : begin - 1;  // a line begins here only after a line break
    bytes.resize(static_cast<std::size_t>(end - from));
    bytes.resize(file_->read(from, bytes.data(), bytes.size()));
    std::size_t skipped = 0;
    if (index > 0) {
      skipped = static_cast<std::size_t>(std::find(bytes.begin(), bytes.end(), '\n') - bytes.begin()) + 1;
      if (skipped >= bytes.size()) {
        bytes.clear();
        return end;
      }
    }
    complete_last_line(end, bytes);
    bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(skipped));
    return from + skipped;
  }

  void complete_last_line(std::uint64_t end, std::vector<char>& bytes) const {
    std::size_t added = 0;
    while (bytes.back() != '\n' && end < layout_.end) {
      constexpr std::size_t kStep = 256;
      const std::size_t old = bytes.size();
      bytes.resize(old + static_cast<std::size_t>(std::min<std::uint64_t>(kStep, layout_.end - end)));
      bytes.resize(old + file_->read(end, bytes.data() + old, bytes.size() - old));
      end += bytes.size() - old;
      added += bytes.size() - old;
      const auto stop = std::find(bytes.begin() + static_cast<std::ptrdiff_t>(old), bytes.end(), '\n');
      if (stop != bytes.end()) {
        bytes.erase(stop + 1, bytes.end());
      }
      if (added > kLongestLine) {
        throw StageError(errors::kScanFormat, file_->name(), "a line of more than a million characters",
                         "give x y z on each line");
      }
    }
  }

  void append(ScanBlock& block, const std::array<double, 6>& values) const {
    block.x.push_back(values[0]);
    block.y.push_back(values[1]);
    block.z.push_back(values[2]);
    if (layout_.normals) {
      block.nx.push_back(static_cast<float>(values[3]));
      block.ny.push_back(static_cast<float>(values[4]));
      block.nz.push_back(static_cast<float>(values[5]));
    }
  }

  /// Blank lines, comments and, in a file that began with one, further count lines are no points and no
  /// errors.
  void take_other_line(const char* begin, const char* end, std::uint64_t offset) const {
    begin = skip_blanks(begin, end);
    while (end > begin && is_blank(end[-1])) {
      --end;
    }
    if (begin == end || is_comment_line(begin, end)) {
      return;
    }
    std::uint64_t count = 0;
    const auto [stop, error] = std::from_chars(begin, end, count);
    if (layout_.promised && error == std::errc() && stop == end) {
      promised_ += count;
      return;
    }
    const std::string shown(begin, std::min<std::size_t>(40, static_cast<std::size_t>(end - begin)));
    throw StageError(errors::kScanBadLine,
                     file_->name() + ": line " + std::to_string(line_number(*file_, offset)),
                     "is no point: '" + shown + "'", "correct or remove the line; each needs at least x y z");
  }

  std::shared_ptr<const ScanBytes> file_;
  TextLayout layout_;
  std::vector<Vec3> stations_;
  mutable std::atomic<std::uint64_t> promised_{0};
};

}  // namespace

std::unique_ptr<ScanReader> open_text(const std::shared_ptr<const ScanBytes>& text,
                                      const std::vector<int>& columns) {
  const TextLayout layout = sniff_text(*text, columns);
  std::unique_ptr<ScanReader> reader = text_reader(text, layout, {});
  reader->note(layout.description);
  return reader;
}

std::unique_ptr<ScanReader> text_reader(const std::shared_ptr<const ScanBytes>& text,
                                        const TextLayout& layout, const std::vector<Vec3>& stations) {
  return std::make_unique<TextReader>(text, layout, stations);
}

}  // namespace roomcut::ingest
