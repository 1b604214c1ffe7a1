// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "tests/unit/artefact/temporary_folder.h"

namespace roomcut::test {

/// An empty work folder that is the current one as long as the object lives.
class WorkFolder {
 public:
  WorkFolder() {
    std::filesystem::current_path(folder_.path());
    std::filesystem::create_directory("stamps");
  }
  ~WorkFolder() { std::filesystem::current_path(before_); }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

 private:
  TemporaryFolder folder_;
  std::filesystem::path before_ = std::filesystem::current_path();
};

}  // namespace roomcut::test
