// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/text_dialect.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "common/text/words.h"
#include "stages/ingest/number_text.h"

namespace roomcut::ingest {

namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::size_t kLongestNumber = 64;

bool is_digit_at(std::string_view text, std::size_t i) {
  return i < text.size() && number_text::is_digit(text[i]);
}

/// Like "1,25": one comma, a digit on both sides.
bool is_decimal_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  return comma != std::string_view::npos && comma > 0 && is_digit_at(word, comma - 1) &&
         is_digit_at(word, comma + 1) && word.find(',', comma + 1) == std::string_view::npos;
}

/// Where the field that begins at `begin` ends: at the separator that follows its quotes, if it has any.
std::size_t end_of_field(std::string_view line, std::size_t begin, const TextDialect& dialect) {
  std::size_t from = begin;
  if (dialect.quotes && begin < line.size() && line[begin] == '"') {
    const std::size_t closing = line.find('"', begin + 1);
    from = closing == std::string_view::npos ? line.size() : closing;
  }
  return std::min(
      dialect.separator == ' ' ? line.find_first_of(kBlanks, from) : line.find(dialect.separator, from),
      line.size());
}

}  // namespace

Fields split_fields(std::string_view line, const TextDialect& dialect) {
  Fields fields;
  line = trimmed(line);
  std::size_t begin = 0;
  while (begin <= line.size()) {
    begin = std::min(line.find_first_not_of(dialect.separator == '\t' ? " \r" : kBlanks, begin), line.size());
    if (begin == line.size() && dialect.separator == ' ') {
      break;
    }
    const std::size_t end = end_of_field(line, begin, dialect);
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return fields;
}

std::string_view unquoted(std::string_view field) {
  return field.size() >= 2 && field.front() == '"' && field.back() == '"'
             ? trimmed(field.substr(1, field.size() - 2))
             : field;
}

bool read_field(std::string_view field, const TextDialect& dialect, double& value) {
  field = unquoted(field);
  if (field.empty() || field.size() > kLongestNumber) {
    return false;
  }
  std::array<char, kLongestNumber> text;
  char* end = std::copy(field.begin(), field.end(), text.data());
  if (dialect.decimal_comma) {
    std::replace(text.data(), end, ',', '.');
  }
  return parse_number(text.data(), end, value) == end;
}

bool is_missing(std::string_view field) {
  static constexpr std::array<std::string_view, 9> kWords{"",    "na",   "n/a", "#n/a", "null",
                                                          "nil", "none", "-",   "--"};
  std::string word(unquoted(field));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

TextDialect dialect_of(std::string_view line) {
  TextDialect dialect;
  dialect.quotes = line.find('"') != std::string_view::npos;
  const Fields words = split_fields(line, dialect);
  const bool decimal = std::any_of(words.begin(), words.end(),
                                   [](std::string_view word) { return is_decimal_comma(unquoted(word)); });
  if (line.find(';') != std::string_view::npos) {
    dialect.separator = ';';
    const Fields fields = split_fields(line, dialect);
    dialect.decimal_comma = std::any_of(fields.begin(), fields.end(), [](std::string_view field) {
      return is_decimal_comma(unquoted(field));
    });
  } else if (line.find(',') != std::string_view::npos) {
    const bool each = std::all_of(words.begin(), words.end(), [](std::string_view word) {
      return word.find(',') == std::string_view::npos || is_decimal_comma(unquoted(word));
    });
    dialect.decimal_comma = decimal && each && words.size() >= 3;
    dialect.separator = dialect.decimal_comma ? ' ' : ',';
  }
  return dialect;
}

}  // namespace roomcut::ingest
