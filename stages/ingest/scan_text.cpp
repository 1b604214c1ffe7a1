// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_text.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <string>

#include "common/errors/codes.h"
#include "stages/ingest/number_text.h"
#include "stages/ingest/scan_stations.h"
#include "stages/ingest/text_layout.h"

namespace roomcut {

namespace {

constexpr std::uint64_t kBlockBytes = 1 << 21;
constexpr std::size_t kLongestLine = 1 << 20;
constexpr std::uint64_t kShortestAsciiPoint = 6;

/// Calls visit(first, last) for each piece of [begin, end) in order, until it returns false.
template <class Visit>
void scan_bytes(const ScanFile& file, std::uint64_t begin, std::uint64_t end, Visit&& visit) {
  std::vector<char> bytes(1 << 20);
  while (begin < end) {
    const std::size_t wanted = static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), end - begin));
    const std::size_t got = file.read(begin, bytes.data(), wanted);
    if (got == 0 || !visit(bytes.data(), bytes.data() + got)) {
      return;
    }
    begin += got;
  }
}

/// Number of the line that begins at `offset`, counted from 1.
std::uint64_t line_number(const ScanFile& file, std::uint64_t offset) {
  std::uint64_t breaks = 0;
  scan_bytes(file, 0, offset, [&](const char* first, const char* last) {
    breaks += static_cast<std::uint64_t>(std::count(first, last, '\n'));
    return true;
  });
  return breaks + 1;
}

/// Where the `lines`-th line that is not blank ends, from `begin` on. `found` is how many there were.
std::uint64_t end_of_lines(const ScanFile& file, std::uint64_t begin, std::uint64_t lines,
                           std::uint64_t& found) {
  std::uint64_t end = begin;
  std::uint64_t position = begin;
  bool blank = true;
  found = 0;
  scan_bytes(file, begin, file.size(), [&](const char* first, const char* last) {
    for (const char* p = first; p < last && found < lines;) {
      const auto* stop = static_cast<const char*>(std::memchr(p, '\n', static_cast<std::size_t>(last - p)));
      const char* line_end = stop == nullptr ? last : stop;
      blank = blank && std::all_of(p, line_end, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
      p = stop == nullptr ? last : stop + 1;
      if (stop != nullptr) {
        found += blank ? 0 : 1;
        blank = true;
      }
      end = position + static_cast<std::uint64_t>(p - first);
    }
    position += static_cast<std::uint64_t>(last - first);
    return found < lines;
  });
  if (found < lines && !blank) {
    ++found;  // a last line without a line break
  }
  return end;
}

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

const char* skip_blanks(const char* p, const char* end) {
  while (p < end && is_blank(*p)) {
    ++p;
  }
  return p;
}

/// Takes one line apart by a layout.
class LineParser {
 public:
  explicit LineParser(const TextLayout& layout) : layout_(layout) {}

  /// Returns whether [p, end) is a point; its numbers are in values().
  bool parse(const char* p, const char* end) {
    for (std::size_t i = 0; i < layout_.fields.size(); ++i) {
      p = skip_blanks(p, end);
      const int field = layout_.fields[i];
      p = field >= 0 ? take_number(p, end, values_[static_cast<std::size_t>(field)])
                     : (field == TextLayout::kList ? skip_list(p, end) : skip_field(p, end));
      if (p == nullptr) {
        return false;
      }
      if (i + 1 < layout_.fields.size() && (p = to_next_field(p, end)) == nullptr) {
        return false;
      }
    }
    return true;
  }
  const std::array<double, 6>& values() const { return values_; }

 private:
  bool ends_field(const char* p, const char* end) const {
    return p == end || is_blank(*p) || *p == layout_.separator;
  }
  const char* take_number(const char* p, const char* end, double& value) const {
    const char* stop = parse_number(p, end, value);
    return stop != nullptr && ends_field(stop, end) ? stop : nullptr;
  }
  const char* skip_field(const char* p, const char* end) const {
    while (p < end && *p != layout_.separator && !(layout_.separator == ' ' && is_blank(*p))) {
      ++p;
    }
    return p;
  }
  const char* skip_list(const char* p, const char* end) const {
    double count = 0;
    p = take_number(p, end, count);
    for (double i = 0; p != nullptr && i < count; ++i) {
      p = skip_blanks(p, end);
      p = p == end ? nullptr : skip_field(p, end);
    }
    return p;
  }
  const char* to_next_field(const char* p, const char* end) const {
    p = skip_blanks(p, end);
    if (layout_.separator == ' ') {
      return p;
    }
    return p < end && *p == layout_.separator ? p + 1 : nullptr;
  }

  const TextLayout& layout_;
  std::array<double, 6> values_{};
};

class TextReader : public ScanReader {
 public:
  TextReader(std::shared_ptr<const ScanFile> file, TextLayout layout, std::vector<Vec3> stations)
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

  std::shared_ptr<const ScanFile> file_;
  TextLayout layout_;
  std::vector<Vec3> stations_;
  mutable std::atomic<std::uint64_t> promised_{0};
};

TextLayout layout_of(const PlyElement& vertex, const PlyColumns& columns) {
  TextLayout layout;
  layout.normals = columns.normals;
  for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
    layout.fields.push_back(vertex.properties[i].is_list ? TextLayout::kList : TextLayout::kSkip);
    for (int column = 0; column < columns.count(); ++column) {
      if (columns.property[static_cast<std::size_t>(column)] == i) {
        layout.fields.back() = column;
      }
    }
  }
  while (layout.fields.back() < 0) {
    layout.fields.pop_back();
  }
  return layout;
}

}  // namespace

std::unique_ptr<ScanReader> open_text(const std::shared_ptr<const ScanFile>& file) {
  return std::make_unique<TextReader>(file, sniff_text(*file), std::vector<Vec3>{});
}

std::unique_ptr<ScanReader> open_ascii_ply(const std::shared_ptr<const ScanFile>& file,
                                           const PlyHeader& header, const PlyColumns& columns) {
  const PlyElement& vertex = header.elements[header.vertex];
  TextLayout layout = layout_of(vertex, columns);
  layout.begin = header.data_offset;
  for (std::size_t i = 0; i <= header.vertex; ++i) {
    const PlyElement& element = header.elements[i];
    std::uint64_t found = 0;
    const bool possible =
        i < header.vertex || element.count <= (file->size() - layout.begin) / kShortestAsciiPoint + 1;
    const std::uint64_t end =
        possible ? end_of_lines(*file, layout.begin, element.count, found) : layout.begin;
    if (found < element.count) {
      throw StageError(errors::kScanTruncated, file->name(),
                       "the header promises " + std::to_string(element.count) + " elements '" + element.name +
                           "', the file holds " + (possible ? std::to_string(found) : std::string("fewer")),
                       "the file was cut off while it was written or copied: export or copy it again");
    }
    (i < header.vertex ? layout.begin : layout.end) = end;
  }
  return std::make_unique<TextReader>(file, layout, stations_of_comments(header.comments));
}

}  // namespace roomcut
