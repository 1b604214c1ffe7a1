// SPDX-License-Identifier: GPL-3.0-or-later
// Gives files to targets in any build: replay FOLDER, which holds a folder for each target. The name of a
// file begins with what must be the answer: the code of the error, or "ok". Ends with 1 when an answer is
// another one.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <vector>

#include "common/artefact/atomic_file.h"
#include "tests/fuzz/target.h"

namespace fs = std::filesystem;
using namespace roomcut;

namespace {

std::vector<fs::path> sorted(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// Whether the answer is the one that the file's name promises.
bool replay(const fuzz::Target& target, const fs::path& file) {
  std::cout << target.name << "/" << file.filename().string() << std::flush;  // at once: it may crash
  const std::string name = file.filename().string();
  const std::string wanted = name.substr(0, name.find('_'));
  std::string got;
  try {
    got = fuzz::answer(target, read_text_file(file));
  } catch (const std::exception& error) {
    got = std::string("unexpected: ") + error.what();
  }
  std::cout << ": " << got << (got == wanted ? "\n" : ", wanted " + wanted + "\n");
  return got == wanted;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: replay FOLDER\n";
    return 2;
  }
  int files = 0;
  int wrong = 0;
  for (const fs::path& folder : sorted(argv[1])) {
    if (!fs::is_directory(folder)) {
      continue;
    }
    const fuzz::Target* target = fuzz::find_target(folder.filename().string());
    if (target == nullptr) {
      std::cout << folder.string() << ": there is no such target\n";
      ++wrong;
      continue;
    }
    for (const fs::path& file : sorted(folder)) {
      ++files;
      wrong += replay(*target, file) ? 0 : 1;
    }
  }
  std::cout << files << " files, " << wrong << " wrong answers\n";
  return wrong == 0 && files > 0 ? 0 : 1;
}
