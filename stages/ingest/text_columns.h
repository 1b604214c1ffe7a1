// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "stages/ingest/text_dialect.h"
#include "stages/ingest/text_names.h"

namespace roomcut::ingest {

/// The beginning of a text table, taken apart.
struct TextHead {
  std::vector<std::string_view> headers;   ///< lines before the first point that are no comments
  std::vector<std::string_view> comments;  ///< without their markers
  std::vector<std::string_view> lines;     ///< the first points
  std::vector<Fields> rows;                ///< their fields
  TextDialect dialect;
};

/// What each column is.
struct ColumnChoice {
  std::vector<int> roles;   ///< up to the last used one
  std::string description;  ///< for the user: "x is column 2 'X', … (names in the header)"
};

/// The columns that a user names: x, y, z, nx, ny, nz in the order of the file, anything else for a column
/// that is not used; separated by commas or blanks. Empty for an empty text. Errors: kUsage.
std::vector<int> parse_columns(const std::string& text);

/// Decides which columns are x, y, z (and normals): as `given`, if it is not empty; by a line of names, when
/// it has as many names as the lines have fields (or one fewer and the first column is an index or row name);
/// without names the first three, behind an index or a label. Anything else is kScanColumns, which shows the
/// header, the first line and what each column would be. `name`: of the file.
ColumnChoice choose_columns(const TextHead& head, const std::vector<int>& given, const std::string& name);

}  // namespace roomcut::ingest
