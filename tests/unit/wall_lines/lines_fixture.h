// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "common/wall_lines/wall_lines_io.h"

namespace roomcut::testing {

inline const std::filesystem::path kSource = ROOMCUT_SOURCE_DIR;
inline const std::filesystem::path kFirstVersion = kSource / "tests/compat/wall_lines_v1.0.geojson";

/// A folder of its own for each test program, removed at the end.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("roomcut_lines_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline std::filesystem::path save(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
  return path;
}

inline WallLine make_line(const std::string& id, const Vec2& a, const Vec2& b) {
  WallLine line;
  line.id = id;
  line.a = a;
  line.b = b;
  return line;
}

inline const WallLine& line_of(const WallLines& lines, const std::string& id) {
  for (const WallLine& line : lines.lines) {
    if (line.id == id) {
      return line;
    }
  }
  throw std::runtime_error("no line " + id);
}

}  // namespace roomcut::testing
