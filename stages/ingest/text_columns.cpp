// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/text_columns.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/errors/codes.h"

namespace roomcut::ingest {

namespace {

constexpr std::array<const char*, 6> kRoles{"x", "y", "z", "nx", "ny", "nz"};
constexpr std::size_t kShown = 72;         // characters of a line
constexpr std::size_t kShownColumns = 12;  // columns of a table
constexpr std::size_t kFewestRows = 3;     // by which a column without a name is known as an index

std::string shown(std::string_view line) {
  std::string text(line.substr(0, kShown));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
  return "'" + text + (line.size() > kShown ? "…'" : "'");
}

/// A line of names that was found, with the names as columns of the rows.
struct NameLine {
  std::string_view text;
  Fields names;
};

class Chooser {
 public:
  Chooser(const TextHead& head, const std::string& name) : head_(head), name_(name) {}

  ColumnChoice by_given(std::vector<int> roles) const {
    if (head_.rows.front().size() <= last_used(roles)) {
      unclear("--columns names more columns than the lines have", {});
    }
    return finish(std::move(roles), {}, "as --columns says");
  }

  ColumnChoice by_names_or_order() const {
    for (auto line = head_.headers.rbegin(); line != head_.headers.rend(); ++line) {
      const NameLine names = name_line(*line);
      const NamedColumns columns = columns_of_names(names.names);
      if (columns.found()) {
        return by_names(names, columns.roles, "names in the header");
      }
      if (line == head_.headers.rbegin()) {
        check_unknown(names, columns);
      }
    }
    for (auto line = head_.comments.rbegin(); line != head_.comments.rend(); ++line) {
      const std::size_t colon = line->find(':');
      const NameLine names = name_line(line->substr(colon == std::string_view::npos ? 0 : colon + 1));
      const NamedColumns columns = columns_of_names(names.names);
      const bool first_three = columns.found() && std::equal(columns.roles.begin(), columns.roles.begin() + 3,
                                                             std::array<int, 3>{0, 1, 2}.begin());
      if (columns.found() && (shift_of(names) >= 0 || !first_three)) {
        return by_names(names, columns.roles, "names in a comment");
      }
    }
    return by_order();
  }

 private:
  static std::size_t last_used(const std::vector<int>& roles) {
    std::size_t last = 0;
    for (std::size_t i = 0; i < roles.size(); ++i) {
      last = roles[i] == kNoRole ? last : i;
    }
    return last;
  }

  /// Splits a line of names as the rows are split; if that gives one name only, at anything.
  NameLine name_line(std::string_view line) const {
    TextDialect dialect = head_.dialect;
    dialect.quotes = true;
    Fields names = split_fields(line, dialect);
    for (const char separator : {';', ',', ' '}) {
      if (names.size() < 3) {
        dialect.separator = separator;
        names = split_fields(line, dialect);
      }
    }
    if (dialect.separator == ' ') {  // "X [m]": a unit is no name of its own
      std::erase_if(names, [](std::string_view name) { return name.front() == '[' || name.front() == '('; });
    }
    while (names.size() > fields() && names.back().empty()) {
      names.pop_back();
    }
    return {line, names};
  }

  std::size_t fields() const { return head_.rows.front().size(); }
  bool same_fields() const {
    return std::all_of(head_.rows.begin(), head_.rows.end(),
                       [this](const Fields& row) { return row.size() == fields(); });
  }

  bool first_is_label() const {
    const auto is_text = [this](std::string_view field) {
      double value = 0;
      return !read_field(field, head_.dialect, value) && !is_missing(field);
    };
    return std::all_of(head_.rows.begin(), head_.rows.end(), [&](const Fields& row) {
      const bool alone_quoted = row.size() > 1 && row[0].starts_with('"') && !row[1].starts_with('"');
      return alone_quoted || is_text(row[0]);
    });
  }

  /// Whether the first column counts the lines.
  bool first_is_index(std::size_t fewest) const {
    double before = 0;
    for (std::size_t i = 0; i < head_.rows.size(); ++i) {
      double value = 0;
      const std::string_view field = head_.rows[i].front();
      if (!read_field(field, head_.dialect, value) || value != std::floor(value) ||
          field.find('.') != std::string_view::npos || (i > 0 && value != before + 1)) {
        return false;
      }
      before = value;
    }
    return head_.rows.size() >= fewest;
  }

  /// How many columns stand before the first name: 0, 1 with an index or row name that has none, −1: the
  /// numbers do not fit.
  int shift_of(const NameLine& names) const {
    if (!same_fields()) {
      return -1;
    }
    if (names.names.size() == fields()) {
      return 0;
    }
    return names.names.size() + 1 == fields() && (first_is_label() || first_is_index(2)) ? 1 : -1;
  }

  ColumnChoice by_names(const NameLine& names, std::vector<int> roles, const std::string& why) const {
    const int shift = shift_of(names);
    if (shift < 0) {
      unclear("there are " + std::to_string(names.names.size()) + " names and " +
                  (same_fields() ? std::to_string(fields()) : std::string("varying numbers of")) +
                  " fields in a line",
              names);
    }
    NameLine shifted = names;
    if (shift > 0) {
      roles.insert(roles.begin(), kNoRole);
      shifted.names.insert(shifted.names.begin(), std::string_view());
    }
    return finish(std::move(roles), shifted, why);
  }

  /// A line of as many names as there are fields, none of which says what is x, y, z.
  void check_unknown(const NameLine& names, const NamedColumns& columns) const {
    if (only_units(names.names)) {
      return;
    }
    const bool alike = names.names.size() == fields() || names.names.size() + 1 == fields();
    if (alike && (columns.known || names.names.size() == fields() || head_.dialect.separator != ' ')) {
      unclear(columns.unclear.empty() ? "the header does not name x, y and z" : columns.unclear, names);
    }
  }

  ColumnChoice by_order() const {
    const bool label = first_is_label();
    if (label && !same_fields()) {
      unclear("the lines have varying numbers of fields", {});
    }
    if (all_whole_pairs()) {
      unclear("all numbers are whole and separated by commas, which may be decimal commas", {});
    }
    std::vector<int> roles(label || (fields() > 3 && first_is_index(kFewestRows)) ? 1 : 0, kNoRole);
    const std::size_t skipped = roles.size();
    roles.insert(roles.end(), {0, 1, 2});
    for (std::size_t i = skipped; i < roles.size(); ++i) {
      double value = 0;
      const Fields& row = head_.rows.front();
      if (i >= row.size() || (!read_field(row[i], head_.dialect, value) && !is_missing(row[i]))) {
        unclear("column " + std::to_string(i + 1) + " is no coordinate and no line names the columns", {});
      }
    }
    return finish(std::move(roles), {},
                  skipped == 0 ? "no names: the first three"
                               : "no names: the three behind the first, which numbers or names the points");
  }

  /// "1,5,2,25,3,0": three numbers with decimal commas, or six.
  bool all_whole_pairs() const {
    return head_.dialect.separator == ',' && fields() >= 6 && fields() % 2 == 0 && same_fields() &&
           std::all_of(head_.lines.begin(), head_.lines.end(), [](std::string_view line) {
             return line.find_first_not_of("0123456789-, \t\r") == std::string_view::npos;
           });
  }

  ColumnChoice finish(std::vector<int> roles, const NameLine& names, const std::string& why) const {
    roles.resize(last_used(roles) + 1);
    return {roles, taken(roles, names) + " (" + why + ")"};
  }

  /// "x is column 2 'X', y is …".
  static std::string taken(const std::vector<int>& roles, const NameLine& names) {
    std::string text;
    for (int role = 0; role < 6; ++role) {
      const auto column = std::find(roles.begin(), roles.end(), role) - roles.begin();
      const auto index = static_cast<std::size_t>(column);
      if (index < roles.size()) {
        text += (text.empty() ? "" : ", ") + std::string(kRoles[static_cast<std::size_t>(role)]) +
                " is column " + std::to_string(index + 1) +
                (index < names.names.size() ? " " + shown(unquoted(names.names[index])) : "");
      }
    }
    return text;
  }

  [[noreturn]] void unclear(const std::string& why, const NameLine& names) const {
    std::string what = why;
    if (!names.text.empty()) {
      what += "; header " + shown(names.text);
    }
    what += "; first line " + shown(head_.lines.front()) + "; taken as";
    const std::vector<int> roles = columns_of_names(names.names).roles;
    for (std::size_t i = 0; i < std::min(fields(), kShownColumns); ++i) {
      const bool named = i < roles.size() && roles[i] != kNoRole;
      what += std::string(i == 0 ? " " : ", ") + std::to_string(i + 1) + ": " +
              (i < names.names.size() ? shown(unquoted(names.names[i])) + " = " : "") +
              shown(head_.rows.front()[i]) +
              (named ? std::string(" as ") + kRoles[static_cast<std::size_t>(roles[i])] : "");
    }
    throw StageError(
        errors::kScanColumns, name_, "it is not certain which columns are x, y and z: " + what,
        "say what each column is, in order, '-' for one that is no coordinate: --columns -,x,y,z "
        "(with make: COLUMNS=-,x,y,z)");
  }

  const TextHead& head_;
  const std::string& name_;
};

}  // namespace

std::vector<int> parse_columns(const std::string& text) {
  std::vector<int> roles;
  std::array<int, 6> times{};
  for (std::size_t begin = text.find_first_not_of(" ,;\t"); begin != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(" ,;\t", begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const auto* const role = std::find(kRoles.begin(), kRoles.end(), word);
    roles.push_back(role == kRoles.end() ? kNoRole : static_cast<int>(role - kRoles.begin()));
    if (role != kRoles.end()) {
      ++times[static_cast<std::size_t>(roles.back())];
    }
    begin = text.find_first_not_of(" ,;\t", end);
  }
  const bool normals = times[3] + times[4] + times[5] > 0;
  for (std::size_t i = 0; i < (normals ? 6U : 3U) && !roles.empty(); ++i) {
    if (times[i] != 1) {
      throw StageError(errors::kUsage, "--columns",
                       "'" + text + "' names " + kRoles[i] + " " + std::to_string(times[i]) + " times",
                       "name x, y and z once each in the order of the file, '-' for other columns: -,x,y,z");
    }
  }
  return roles;
}

ColumnChoice choose_columns(const TextHead& head, const std::vector<int>& given, const std::string& name) {
  const Chooser chooser(head, name);
  return given.empty() ? chooser.by_names_or_order() : chooser.by_given(given);
}

}  // namespace roomcut::ingest
