// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/text_layout.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>

#include "common/errors/codes.h"
#include "stages/ingest/number_text.h"

namespace roomcut {

namespace {

constexpr std::size_t kSniffed = 1 << 18;
constexpr int kLongestHeader = 20;           // lines of names and remarks before the first point
constexpr std::uint64_t kShortestPoint = 6;  // "0 0 0" and a line break
constexpr std::size_t kTooManyWords = 30;    // of the only line of a text

using Words = std::vector<std::string_view>;

Words split(std::string_view line, std::string_view separators) {
  Words words;
  std::size_t begin = 0;
  while ((begin = line.find_first_not_of(separators, begin)) != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

bool is_number(std::string_view word) {
  double value = 0;
  return parse_number(word.data(), word.data() + word.size(), value) == word.data() + word.size();
}

bool is_count(std::string_view word) {
  return word.size() <= 19 &&
         std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c); });
}

/// Whether each of several blank-separated words is like "1,25".
bool has_decimal_commas(std::string_view line) {
  const Words words = split(line, " \t;\r");
  return words.size() >= 3 && std::all_of(words.begin(), words.end(), [](std::string_view word) {
           const std::size_t comma = word.find(',');
           return comma != std::string_view::npos && comma > 0 && comma + 1 < word.size() &&
                  word.find(',', comma + 1) == std::string_view::npos;
         });
}

std::string bare_name(std::string_view word) {
  std::string name;
  for (const char c : word) {
    if (c == '(' || c == '[') {
      break;  // a unit, as in "x[m]"
    }
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return name;
}

int column_of(const std::string& name) {
  static const std::array<std::vector<std::string>, 6> kNames{
      {{"x", "easting", "xcoord", "coordx"},
       {"y", "northing", "ycoord", "coordy"},
       {"z", "height", "elevation", "zcoord", "coordz"},
       {"nx", "normalx", "xnormal"},
       {"ny", "normaly", "ynormal"},
       {"nz", "normalz", "znormal"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (std::find(kNames[i].begin(), kNames[i].end(), name) != kNames[i].end()) {
      return static_cast<int>(i);
    }
  }
  return TextLayout::kSkip;
}

/// The fields that a line of names gives; empty when x, y, z are not all among them, once each.
std::vector<int> fields_of_names(std::string_view line) {
  std::vector<int> fields;
  for (const std::string_view word : split(line, " \t,;\r")) {
    if (const std::string name = bare_name(word); !name.empty()) {
      fields.push_back(column_of(name));
    }
  }
  const auto times = [&](int column) { return std::count(fields.begin(), fields.end(), column); };
  if (times(0) != 1 || times(1) != 1 || times(2) != 1) {
    return {};
  }
  if (times(3) != 1 || times(4) != 1 || times(5) != 1) {
    std::replace_if(
        fields.begin(), fields.end(), [](int column) { return column > 2; }, TextLayout::kSkip);
  }
  while (fields.back() == TextLayout::kSkip) {
    fields.pop_back();
  }
  return fields;
}

/// Goes through the first lines until the first point.
class Sniffer {
 public:
  explicit Sniffer(const ScanBytes& file) : file_(file) {
    layout_.fields = {0, 1, 2};
    layout_.end = file.size();
  }

  /// Returns true when the line is the first point.
  bool take(std::string_view line, std::uint64_t offset) {
    const Words words = split(line, " \t,;\r");
    if (words.empty()) {
      return false;
    }
    if (is_comment_line(line.data(), line.data() + line.size())) {
      take_names(line);
      return false;
    }
    if (has_decimal_commas(line) && line.find_first_of("0123456789") != std::string_view::npos) {
      refuse("the numbers are written with decimal commas", "export with decimal points");
    }
    if (!is_number(words[0])) {
      take_header(line, words);
      return false;
    }
    if (words.size() == 1 && is_count(words[0])) {
      take_count(words[0]);
      return false;
    }
    return take_point(line, words, offset);
  }

  TextLayout finish() {
    layout_.normals = std::find(layout_.fields.begin(), layout_.fields.end(), 3) != layout_.fields.end();
    return layout_;
  }
  /// A line with nothing behind it in what was looked at.
  void check_last_line(std::string_view line) const {
    const Words words = split(line, " \t,;\r");
    const auto numbers = std::count_if(words.begin(), words.end(), is_number);
    if (words.size() > kTooManyWords && 2 * static_cast<std::size_t>(numbers) > words.size()) {
      refuse("all points stand on one line: there is no line break",
             "write the numbers of each point on a line of their own");
    }
  }
  bool saw_header() const { return named_ || layout_.promised || comments_ > 0; }
  [[noreturn]] void refuse(const std::string& what,
                           const std::string& hint = "give PLY, or text with x y z on each line") const {
    throw StageError(errors::kScanFormat, file_.name(), what, hint);
  }

 private:
  void take_names(std::string_view line) {
    ++comments_;
    if (std::vector<int> fields = fields_of_names(line); !fields.empty()) {
      layout_.fields = std::move(fields);
    }
  }

  void take_header(std::string_view line, const Words& words) {
    if (bare_name(words[0]) == "ncols") {
      refuse("this is an ESRI grid, not a point cloud");
    }
    if (++header_lines_ > kLongestHeader) {
      refuse("text without points: none of the first " + std::to_string(kLongestHeader) +
             " lines has coordinates");
    }
    if (std::vector<int> fields = fields_of_names(line); !fields.empty()) {
      layout_.fields = std::move(fields);
      named_ = true;
    }
  }

  void take_count(std::string_view word) {
    if (layout_.promised) {
      refuse("two counts at the beginning: this looks like a PTX file",
             "convert it to PLY or text, e.g. with CloudCompare");
    }
    std::uint64_t count = 0;
    std::from_chars(word.data(), word.data() + word.size(), count);
    if (count > file_.size() / kShortestPoint) {
      throw StageError(errors::kScanTruncated, file_.name(),
                       "the count line promises " + std::to_string(count) + " points, the file has only " +
                           std::to_string(file_.size()) + " bytes",
                       "export or copy the scan again");
    }
    layout_.promised = count;
  }

  bool take_point(std::string_view line, const Words& words, std::uint64_t offset) {
    if (line.find(';') != std::string_view::npos) {
      layout_.separator = ';';
    } else if (line.find(',') != std::string_view::npos) {
      layout_.separator = ',';
    }
    const bool enough = words.size() >= 3 && std::all_of(words.begin(), words.begin() + 3, is_number);
    if (!enough) {
      refuse("the first line with numbers is no point", "give x y z on each line");
    }
    layout_.begin = offset;
    return true;
  }

  const ScanBytes& file_;
  TextLayout layout_;
  int header_lines_ = 0;
  int comments_ = 0;
  bool named_ = false;
};

}  // namespace

bool is_comment_line(const char* begin, const char* end) {
  while (begin < end && (*begin == ' ' || *begin == '\t')) {
    ++begin;
  }
  return begin < end &&
         (*begin == '#' || *begin == '%' || (*begin == '/' && begin + 1 < end && begin[1] == '/'));
}

TextLayout sniff_text(const ScanBytes& file) {
  std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), kSniffed)), '\0');
  text.resize(file.read(0, text.data(), text.size()));
  Sniffer sniffer(file);
  if (text.find('\0') != std::string::npos) {
    sniffer.refuse("binary data in no format that is known here",
                   "give PLY or text; convert other formats, e.g. with CloudCompare or PDAL");
  }
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (text.find_first_not_of(" \t\r\n", end) == std::string::npos) {
      sniffer.check_last_line(std::string_view(text).substr(begin, end - begin));
    }
    if (sniffer.take(std::string_view(text).substr(begin, end - begin), begin)) {
      return sniffer.finish();
    }
    begin = end + 1;
  }
  if (sniffer.saw_header() && file.size() <= kSniffed) {
    throw StageError(errors::kScanNoPoints, file.name(),
                     "there are header or comment lines and not one point", "export the scan again");
  }
  sniffer.refuse("text without points");
}

}  // namespace roomcut
