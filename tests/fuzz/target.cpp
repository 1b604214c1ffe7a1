// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/target.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "common/errors/error.h"

namespace roomcut::fuzz {

namespace fs = std::filesystem;

std::span<const Target> targets() {
  static const std::vector<Target> kAll = [] {
    std::vector<Target> all;
    for (const std::span<const Target> some :
         {scan_targets(), hdf5_targets(), json_targets(), text_targets()}) {
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }();
  return kAll;
}

const Target* find_target(std::string_view name) {
  const std::span<const Target> all = targets();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Target& t) { return t.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string answer(const Target& target, std::string_view bytes) {
  try {
    target.feed(bytes);
    return "ok";
  } catch (const StageError& error) {
    for (const Problem& problem : error.problems()) {
      if (problem.hint.empty() || problem.what.empty()) {
        throw std::logic_error("an answer without cause or hint: " + to_string(problem));
      }
    }
    return error.problems().front().code.id;
  }
}

fs::path seeds() {
  const char* folder = std::getenv("ROOMCUT_FUZZ_SEEDS");
  if (folder == nullptr) {
    throw std::runtime_error("ROOMCUT_FUZZ_SEEDS is not set: a folder with a sound run; make fuzz sets it");
  }
  return folder;
}

namespace {

/// fuzz.py takes it away: neither libFuzzer nor a crash lets a process end so that it could do that itself.
fs::path make_folder() {
  std::string name = fs::temp_directory_path() / "roomcut_fuzz_XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error("no private folder can be made: " + name);
  }
  return name;
}

}  // namespace

const fs::path& private_folder() {
  static const fs::path kFolder = make_folder();
  return kFolder;
}

PrivateFile::PrivateFile(std::string_view bytes, std::string_view ending)
    : path_(private_folder() / ("input" + std::string(ending))) {
  std::ofstream file(path_, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    throw std::runtime_error("cannot write " + path_.string());
  }
}

PrivateFile::~PrivateFile() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

}  // namespace roomcut::fuzz
