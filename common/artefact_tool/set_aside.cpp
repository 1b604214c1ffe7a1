// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact_tool/set_aside.h"

#include <algorithm>
#include <filesystem>

#include "common/errors/codes.h"

namespace roomcut {

namespace fs = std::filesystem;

namespace {

constexpr const char* kOldEdits = "edits/old";

/// A name that is free: "edits/old/30_detect_lines.wall_lines.1.geojson".
fs::path free_place(const std::string& name) {
  std::string flat = name;
  std::replace(flat.begin(), flat.end(), '/', '.');
  const fs::path path(flat);
  for (int n = 1;; ++n) {
    fs::path place =
        fs::path(kOldEdits) / (path.stem().string() + "." + std::to_string(n) + path.extension().string());
    if (!fs::exists(fs::symlink_status(place))) {
      return place;
    }
  }
}

std::string moved_aside(const std::string& stage, const std::string& name) {
  std::error_code error;
  fs::create_directories(kOldEdits, error);
  const fs::path place = free_place(name);
  fs::rename(name, place, error);
  if (error) {
    throw StageError(errors::kCannotWrite, place.string(),
                     name + " was changed and cannot be moved there: " + error.message(),
                     "move it out of the work folder yourself");
  }
  const bool lines = fs::path(name).extension() == ".geojson";
  return name + " was changed or damaged after " + stage + " wrote it; it lies now in " + place.string() +
         " and is made again" + (lines ? " (wall lines are edited in edits/wall_lines.geojson)" : "");
}

}  // namespace

std::vector<std::string> set_aside(const std::vector<StaleStage>& stale) {
  std::vector<std::string> notes;
  for (const StaleStage& stage : stale) {
    for (const std::string& name : stage.damaged) {
      notes.push_back(fs::path(name).extension() == ".h5" ? name + " was changed or damaged after " +
                                                                stage.name + " wrote it; it is made again"
                                                          : moved_aside(stage.name, name));
    }
  }
  return notes;
}

}  // namespace roomcut
