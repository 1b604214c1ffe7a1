// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

namespace roomcut::ingest {

/// How the fields of a text table's lines are written.
struct TextDialect {
  char separator = ' ';        ///< ' ' stands for any run of spaces and tabs
  bool decimal_comma = false;  ///< 1,25 is a number
  bool quotes = false;         ///< fields may stand in double quotes
  bool plain() const { return !decimal_comma && !quotes; }
  bool operator==(const TextDialect&) const = default;
};

using Fields = std::vector<std::string_view>;

/// The fields of a line without the blanks around them; quotes are kept. An empty field counts, but for
/// separator ' '.
Fields split_fields(std::string_view line, const TextDialect& dialect);

/// A field without the quotes around it.
std::string_view unquoted(std::string_view field);

/// Reads a whole field, quoted or not. Returns whether it is a number.
bool read_field(std::string_view field, const TextDialect& dialect, double& value);

/// Whether a field says that there is no value: empty (where the separator is no blank), NA, null, - …
bool is_missing(std::string_view field);

/// How a line of numbers is written, by itself: a semicolon separates; commas are decimal when fields
/// separated by blanks have one each ("1,5 100 2,25"), otherwise they separate; else blanks do.
TextDialect dialect_of(std::string_view line);

}  // namespace roomcut::ingest
