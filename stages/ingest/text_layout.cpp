// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/text_layout.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>

#include "common/errors/codes.h"
#include "stages/ingest/text_columns.h"

namespace roomcut::ingest {

namespace {

constexpr std::size_t kSniffed = 1 << 18;
constexpr std::size_t kLongestHeader = 20;   // lines of names and remarks before the first point
constexpr std::size_t kSniffedRows = 200;    // points that the columns are judged by
constexpr std::size_t kTooManyWords = 30;    // of the only line of a text
constexpr std::uint64_t kShortestPoint = 6;  // "0 0 0" and a line break

enum class LineKind { kBlank, kComment, kCount, kOther };

struct Line {
  std::string_view text;
  std::uint64_t offset;
  LineKind kind;
};

bool is_count(std::string_view word) {
  return !word.empty() && word.size() <= 19 &&
         std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c); });
}

LineKind kind_of(std::string_view line) {
  const Fields words = split_fields(line, {});
  if (words.empty()) {
    return LineKind::kBlank;
  }
  if (is_comment_line(line.data(), line.data() + line.size())) {
    return LineKind::kComment;
  }
  return words.size() == 1 && is_count(words[0]) ? LineKind::kCount : LineKind::kOther;
}

/// Numbers among the fields of a line, missing ones counted; 0 without any real one.
std::size_t numbers_in(std::string_view line, const TextDialect& dialect) {
  std::size_t numbers = 0;
  std::size_t missing = 0;
  for (const std::string_view field : split_fields(line, dialect)) {
    double value = 0;
    numbers += read_field(field, dialect, value) ? 1 : 0;
    missing += is_missing(field) ? 1 : 0;
  }
  return numbers == 0 ? 0 : numbers + missing;
}

bool is_row(std::string_view line) {
  return numbers_in(line, dialect_of(line)) >= 3;
}

bool begins_with_number(std::string_view line) {
  const TextDialect dialect = dialect_of(line);
  double value = 0;
  const std::string_view first = split_fields(line, dialect).front();
  return read_field(first, dialect, value) || is_missing(first);
}

/// The first lines of a text, up to the points that the columns are judged by.
class Sniffer {
 public:
  Sniffer(const ScanBytes& text, const std::vector<int>& given) : text_(text), given_(given) {
    head_bytes_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(text.size(), kSniffed)));
    head_bytes_.resize(text.read(0, head_bytes_.data(), head_bytes_.size()));
    if (head_bytes_.find('\0') != std::string::npos) {
      refuse("binary data in no format that is known here",
             "give PLY or text; convert other formats, e.g. with CloudCompare or PDAL");
    }
    split_lines();
  }

  TextLayout layout() {
    const std::size_t body = first_row();
    TextHead head;
    for (std::size_t i = 0; i < body; ++i) {
      take_before(lines_[i], head);
    }
    take_rows(body, head);
    settle_dialect(head);
    const ColumnChoice choice = choose_columns(head, given_, text_.name());
    layout_.dialect = head.dialect;
    layout_.fields = choice.roles;
    layout_.description = choice.description;
    layout_.normals = std::find(layout_.fields.begin(), layout_.fields.end(), 3) != layout_.fields.end();
    layout_.begin = lines_[body].offset;
    layout_.end = text_.size();
    return layout_;
  }

 private:
  [[noreturn]] void refuse(const std::string& what,
                           const std::string& hint = "give PLY, or text with x y z on each line") const {
    throw StageError(errors::kScanFormat, text_.name(), what, hint);
  }

  void split_lines() {
    const std::string_view bytes(head_bytes_);
    for (std::size_t begin = 0; begin < bytes.size();) {
      const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
      const std::string_view line = bytes.substr(begin, end - begin);
      if (bytes.find_first_not_of(" \t\r\n", end) == std::string::npos) {
        check_last(line);
      }
      const bool cut = end == bytes.size() && text_.size() > bytes.size();
      if (!cut || lines_.empty()) {
        lines_.push_back({line, begin, kind_of(line)});
      }
      begin = end + 1;
    }
  }

  /// A line with nothing behind it in what was looked at.
  void check_last(std::string_view line) const {
    TextDialect dialect = dialect_of(line);
    const Fields words = split_fields(line, dialect);
    if (words.size() > kTooManyWords && 2 * numbers_in(line, dialect) > words.size() && lines_.size() < 3) {
      refuse("all points stand on one line: there is no line break",
             "write the numbers of each point on a line of their own");
    }
  }

  /// Index of the first line that is a point.
  std::size_t first_row() const {
    std::size_t others = 0;
    bool numbers = false;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (lines_[i].kind != LineKind::kOther) {
        continue;
      }
      const auto next = std::find_if(lines_.begin() + static_cast<std::ptrdiff_t>(i) + 1, lines_.end(),
                                     [](const Line& line) { return line.kind == LineKind::kOther; });
      // "Survey of 28 11 2026" has three numbers, too; what follows tells.
      if (is_row(lines_[i].text) &&
          (begins_with_number(lines_[i].text) || next == lines_.end() || !begins_with_number(next->text))) {
        return i;
      }
      if (bare_name(lines_[i].text.substr(0, lines_[i].text.find_first_of(" \t"))) == "ncols") {
        refuse("this is an ESRI grid, not a point cloud");
      }
      numbers = numbers || numbers_in(lines_[i].text, dialect_of(lines_[i].text)) > 1;
      if (++others > kLongestHeader) {
        break;
      }
    }
    if (numbers) {
      refuse("the first line with numbers is no point", "give x y z on each line");
    }
    if (others > kLongestHeader) {
      refuse("text without points: none of the first " + std::to_string(kLongestHeader) +
             " lines has coordinates");
    }
    no_points();
  }

  [[noreturn]] void no_points() const {
    const bool header = std::any_of(lines_.begin(), lines_.end(), [](const Line& line) {
      return line.kind == LineKind::kComment || line.kind == LineKind::kCount ||
             columns_of_names(split_fields(line.text, dialect_of(line.text))).found();
    });
    if (header && text_.size() <= kSniffed) {
      throw StageError(errors::kScanNoPoints, text_.name(),
                       "there are header or comment lines and not one point", "export the scan again");
    }
    refuse("text without points");
  }

  void take_before(const Line& line, TextHead& head) {
    switch (line.kind) {
      case LineKind::kOther:
        head.headers.push_back(line.text);
        break;
      case LineKind::kComment:
        head.comments.push_back(
            line.text.substr(std::min(line.text.find_first_not_of("#%/ \t"), line.text.size())));
        break;
      case LineKind::kCount:
        take_count(split_fields(line.text, {}).front());
        break;
      case LineKind::kBlank:
        break;
    }
  }

  void take_count(std::string_view word) {
    if (layout_.promised) {
      refuse("two counts at the beginning, as in a PTX file, but not the ten lines of its header",
             "export the scan again");
    }
    std::uint64_t count = 0;
    std::from_chars(word.data(), word.data() + word.size(), count);
    if (count > text_.size() / kShortestPoint) {
      throw StageError(errors::kScanTruncated, text_.name(),
                       "the count line promises " + std::to_string(count) + " points, the file has only " +
                           std::to_string(text_.size()) + " bytes",
                       "export or copy the scan again");
    }
    layout_.promised = count;
  }

  void take_rows(std::size_t body, TextHead& head) const {
    for (std::size_t i = body; i < lines_.size() && head.lines.size() < kSniffedRows; ++i) {
      if (lines_[i].kind == LineKind::kOther) {
        head.lines.push_back(lines_[i].text);
      }
    }
  }

  /// One dialect for all rows. Tabs separate strictly only where the line of names needs it ("GPS Time"), or
  /// where two of them leave a field empty so that the number of fields stays the same.
  static void settle_dialect(TextHead& head) {
    head.dialect = dialect_of(head.lines.front());
    for (const std::string_view line : head.lines) {
      const TextDialect dialect = dialect_of(line);
      head.dialect.quotes = head.dialect.quotes || dialect.quotes;
      if (dialect.separator == head.dialect.separator) {
        head.dialect.decimal_comma = head.dialect.decimal_comma || dialect.decimal_comma;
      }
    }
    const auto has_tab = [](std::string_view line) { return line.find('\t') != std::string_view::npos; };
    if (head.dialect.separator == ' ' && std::all_of(head.lines.begin(), head.lines.end(), has_tab)) {
      const bool named = std::any_of(head.headers.begin(), head.headers.end(), has_tab) ||
                         std::any_of(head.comments.begin(), head.comments.end(), has_tab);
      if (named || !same_fields(head)) {
        head.dialect.separator = '\t';
      }
    }
    split_rows(head);
  }

  static bool same_fields(TextHead& head) {
    split_rows(head);
    return std::all_of(head.rows.begin(), head.rows.end(),
                       [&](const Fields& row) { return row.size() == head.rows.front().size(); });
  }

  /// A last column that is empty in all rows is none: "1;2;3;".
  static void split_rows(TextHead& head) {
    head.rows.clear();
    for (const std::string_view line : head.lines) {
      head.rows.push_back(split_fields(line, head.dialect));
    }
    const auto ends_empty = [](const Fields& row) { return row.size() > 3 && row.back().empty(); };
    if (std::all_of(head.rows.begin(), head.rows.end(), ends_empty)) {
      for (Fields& row : head.rows) {
        row.pop_back();
      }
    }
  }

  const ScanBytes& text_;
  const std::vector<int>& given_;
  std::string head_bytes_;
  std::vector<Line> lines_;
  TextLayout layout_;
};

}  // namespace

bool is_comment_line(const char* begin, const char* end) {
  while (begin < end && (*begin == ' ' || *begin == '\t')) {
    ++begin;
  }
  return begin < end &&
         (*begin == '#' || *begin == '%' || (*begin == '/' && begin + 1 < end && begin[1] == '/'));
}

TextLayout sniff_text(const ScanBytes& text, const std::vector<int>& given) {
  return Sniffer(text, given).layout();
}

}  // namespace roomcut::ingest
