// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/pcd_header.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>
#include <string_view>

#include "common/errors/codes.h"
#include "stages/ingest/text_dialect.h"

namespace roomcut::ingest {

namespace {

constexpr std::size_t kLargestHeader = 1 << 16;
constexpr std::uint64_t kMostNumbers = 1 << 20;  // of one point

std::string_view head_of(const ScanBytes& text, std::string& bytes) {
  bytes.resize(kLargestHeader);
  bytes.resize(text.read(0, bytes.data(), bytes.size()));
  return bytes;
}

/// Takes the header apart line by line; every error names the line.
class HeaderParser {
 public:
  explicit HeaderParser(const ScanBytes& file) : file_(file) {}

  /// Returns true at DATA.
  bool take(std::string_view line) {
    ++line_;
    const Fields words = split_fields(line, {});
    if (words.empty() || words[0].starts_with('#')) {
      return false;
    }
    const std::string_view key = words[0];
    const Fields values(words.begin() + 1, words.end());
    if (key == "FIELDS" || key == "COLUMNS") {
      names_ = values;
    } else if (key == "SIZE") {
      sizes_ = numbers(values);
    } else if (key == "TYPE") {
      types_ = values;
    } else if (key == "COUNT") {
      counts_ = numbers(values);
    } else if (key == "WIDTH" || key == "HEIGHT" || key == "POINTS") {
      (key == "WIDTH" ? width_ : key == "HEIGHT" ? height_ : points_) = number(values);
    } else if (key == "VIEWPOINT") {
      take_viewpoint(values);
    } else if (key == "DATA") {
      take_data(values);
      return true;
    } else if (key != "VERSION") {
      wrong("unknown keyword '" + std::string(key.substr(0, 40)) + "'");
    }
    return false;
  }

  PcdHeader finish() {
    const std::size_t fields = names_.size();
    if (fields == 0 || (!sizes_.empty() && sizes_.size() != fields) ||
        (!types_.empty() && types_.size() != fields) || (!counts_.empty() && counts_.size() != fields)) {
      wrong("FIELDS, SIZE, TYPE and COUNT differ in their number of values");
    }
    if (header_.data != PcdData::kAscii && (sizes_.empty() || types_.empty())) {
      wrong("SIZE or TYPE is missing");
    }
    std::uint64_t in_all = 0;
    for (std::size_t i = 0; i < fields; ++i) {
      PcdField field{std::string(names_[i]), types_.empty() ? 'F' : types_[i].front(),
                     sizes_.empty() ? 4 : sizes_[i], counts_.empty() ? 1 : counts_[i]};
      in_all += std::min(field.count, kMostNumbers + 1);
      if ((field.size != 1 && field.size != 2 && field.size != 4 && field.size != 8) ||
          in_all > kMostNumbers) {
        wrong("field '" + field.name + "' has an impossible size or count");
      }
      header_.fields.push_back(std::move(field));
    }
    header_.points = count_of_points();
    return std::move(header_);
  }

 private:
  [[noreturn]] void wrong(const std::string& what) const {
    throw StageError(errors::kScanFormat, file_.name() + ": header line " + std::to_string(line_), what,
                     "export the scan again as PCD or PLY");
  }

  std::uint64_t number(const Fields& values) const {
    const std::vector<std::uint64_t> all = numbers(values);
    if (all.size() != 1) {
      wrong("one number is expected");
    }
    return all.front();
  }
  std::vector<std::uint64_t> numbers(const Fields& values) const {
    std::vector<std::uint64_t> result;
    for (const std::string_view value : values) {
      std::uint64_t number = 0;
      const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
      if (error != std::errc() || end != value.data() + value.size()) {
        wrong("'" + std::string(value.substr(0, 40)) + "' is no count");
      }
      result.push_back(number);
    }
    return result;
  }

  void take_viewpoint(const Fields& values) {
    for (std::size_t i = 0; i < header_.viewpoint.size(); ++i) {
      if (i >= values.size() || !read_field(values[i], {}, header_.viewpoint[i])) {
        wrong("VIEWPOINT needs seven numbers");
      }
    }
  }
  void take_data(const Fields& values) {
    const std::string_view kind = values.empty() ? std::string_view() : values[0];
    if (kind == "ascii") {
      header_.data = PcdData::kAscii;
    } else if (kind == "binary") {
      header_.data = PcdData::kBinary;
    } else if (kind == "binary_compressed") {
      header_.data = PcdData::kCompressed;
    } else {
      wrong("unknown kind of DATA '" + std::string(kind.substr(0, 40)) + "'");
    }
  }

  std::uint64_t count_of_points() const {
    std::optional<std::uint64_t> product;
    if (width_ && height_) {
      std::uint64_t value = 0;
      if (__builtin_mul_overflow(*width_, *height_, &value)) {
        wrong("WIDTH times HEIGHT is no number of points");
      }
      product = value;
    }
    if (points_ && product && *points_ != *product) {
      wrong("POINTS is " + std::to_string(*points_) + ", WIDTH times HEIGHT " + std::to_string(*product));
    }
    if (!points_ && !product) {
      wrong("neither POINTS nor WIDTH and HEIGHT");
    }
    return points_ ? *points_ : *product;
  }

  const ScanBytes& file_;
  PcdHeader header_;
  std::size_t line_ = 0;
  Fields names_, types_;
  std::vector<std::uint64_t> sizes_, counts_;
  std::optional<std::uint64_t> width_, height_, points_;
};

}  // namespace

std::uint64_t PcdHeader::record_bytes() const {
  return std::accumulate(
      fields.begin(), fields.end(), std::uint64_t{0},
      [](std::uint64_t sum, const PcdField& field) { return sum + field.size * field.count; });
}

bool is_pcd(const ScanBytes& text) {
  std::string bytes;
  const std::string_view head = head_of(text, bytes);
  bool fields = false;
  for (std::size_t begin = 0; begin < head.size();) {
    const std::size_t end = std::min(head.find('\n', begin), head.size());
    const std::string_view line = head.substr(begin, end - begin);
    if (begin == 0 && (line.starts_with("# .PCD") || line.starts_with("#.PCD"))) {
      return true;
    }
    fields = fields || line.starts_with("FIELDS ") || line.starts_with("COLUMNS ");
    if (fields && line.starts_with("DATA ")) {
      return true;
    }
    begin = end + 1;
  }
  return false;
}

PcdHeader read_pcd_header(const ScanBytes& text) {
  std::string bytes;
  const std::string_view head = head_of(text, bytes);
  HeaderParser parser(text);
  for (std::size_t begin = 0; begin < head.size();) {
    const std::size_t end = head.find('\n', begin);
    if (end == std::string_view::npos) {
      break;  // a line cut in its middle says nothing
    }
    const bool done = parser.take(head.substr(begin, end - begin));
    begin = end + 1;
    if (done) {
      PcdHeader header = parser.finish();
      header.data_offset = begin;
      return header;
    }
  }
  throw StageError(errors::kScanTruncated, text.name(), "the PCD header ends before DATA",
                   "export or copy the scan again");
}

}  // namespace roomcut::ingest
