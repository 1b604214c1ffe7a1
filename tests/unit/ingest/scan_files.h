// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "common/errors/error.h"
#include "stages/ingest/scan_reader.h"

namespace roomcut::testing {
using namespace roomcut::ingest;

/// A folder of its own for one test, gone after it.
class ScanFiles : public ::testing::Test {
 protected:
  ScanFiles() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("roomcut_ingest_") + info->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~ScanFiles() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// All blocks of a reader, one after the other.
inline ScanBlock read_all(const ScanReader& reader) {
  ScanBlock all;
  for (std::size_t i = 0; i < reader.blocks(); ++i) {
    ScanBlock block;
    reader.read(i, block);
    for (const auto axis : {&ScanBlock::x, &ScanBlock::y, &ScanBlock::z}) {
      (all.*axis).insert((all.*axis).end(), (block.*axis).begin(), (block.*axis).end());
    }
    for (const auto axis : {&ScanBlock::nx, &ScanBlock::ny, &ScanBlock::nz}) {
      (all.*axis).insert((all.*axis).end(), (block.*axis).begin(), (block.*axis).end());
    }
  }
  reader.check_total(all.size());
  return all;
}

/// The error code that `action` ends with, and its text; "" when it does not throw.
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

/// Opens and reads everything; returns the code of the error.
inline std::string code_of_scan(const std::filesystem::path& path, std::string* text = nullptr) {
  return code_of([&] { read_all(*open_scan(path)); }, text);
}

/// The bytes of a value, in the machine's order or turned.
template <class T>
std::string bytes_of_value(T value, bool big_endian = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

/// ASCII text as UTF-16 with a byte-order mark.
inline std::string utf16(const std::string& text, bool big_endian) {
  std::string bytes = big_endian ? "\xfe\xff" : "\xff\xfe";
  for (const char c : text) {
    bytes += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  }
  return bytes;
}

}  // namespace roomcut::testing
