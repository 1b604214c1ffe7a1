// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "common/errors/error.h"

namespace roomcut::test {

/// An empty folder that goes with the object; its name has a space and a letter beyond ASCII.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto base = std::filesystem::temp_directory_path() / "roomcut büro XXXXXX";
    std::string text = base.string();
    path_ = ::mkdtemp(text.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void put_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Sets a modification time that no file of this run can have by chance.
inline void make_old(const std::filesystem::path& path) {
  const std::array<timespec, 2> times{timespec{1000000000, 5}, timespec{1000000000, 5}};
  ASSERT_EQ(::utimensat(AT_FDCWD, path.c_str(), times.data(), 0), 0);
}

inline bool is_old(const std::filesystem::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && status.st_mtim.tv_sec == 1000000000;
}

/// The code of the StageError that `action` throws; "" when it throws none.
inline std::string code_of(const std::function<void()>& action, std::string* text = nullptr) {
  try {
    action();
  } catch (const StageError& error) {
    if (text != nullptr) {
      *text = error.what();
    }
    return error.problems().front().code.id;
  }
  return "";
}

}  // namespace roomcut::test
