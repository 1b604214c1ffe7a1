// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/edit_store.h"

#include "common/artefact/atomic_file.h"
#include "common/errors/codes.h"
#include "common/wall_lines/describe_changes.h"
#include "common/wall_lines/wall_lines_io.h"

namespace roomcut::view {

namespace fs = std::filesystem;

namespace {

/// Problems name the file as the user knows it, not the one that was written beside it to be checked.
[[noreturn]] void rethrow_for(const StageError& error, const std::string& checked, const std::string& name) {
  std::vector<Problem> problems = error.problems();
  for (Problem& problem : problems) {
    if (problem.where.starts_with(checked)) {
      problem.where.replace(0, checked.size(), name);
    }
  }
  throw StageError(std::move(problems));
}

}  // namespace

bool EditStore::exists() const {
  std::error_code error;
  return fs::is_regular_file(fs::symlink_status(edit(), error));  // a link could lead out of the folder
}

std::optional<std::string> EditStore::read() const {
  const std::scoped_lock lock(mutex_);
  return exists() ? std::optional(read_text_file(edit())) : std::nullopt;
}

AcceptedEdit EditStore::accept(const std::string& text) {
  const std::scoped_lock lock(mutex_);
  const WallLinesFile detected = read_wall_lines(work_ / "30_detect_lines" / "wall_lines.geojson");
  AtomicFile file(edit());
  file.write(text);
  AcceptedEdit result;
  try {
    const WallLinesFile lines = read_edited_wall_lines(file.temporary_path(), detected.content);
    const LineDifferences changes = compare_lines(detected.content.lines, lines.content.lines);
    result.changes =
        describe_changes(changes, detected.content.lines, lines.content.lines, detected.content.frame);
    result.warnings = lines.warnings;
    if (!lines.content.base_sha256.empty() && lines.content.base_sha256 != detected.payload_sha256) {
      result.warnings.emplace_back("the lines were detected anew since this edit began");
    }
  } catch (const StageError& error) {
    rethrow_for(error, file.temporary_path().string(), "edits/wall_lines.geojson");
  }
  for (std::string& warning : result.warnings) {
    const std::size_t at = warning.find(file.temporary_path().string());
    if (at != std::string::npos) {
      warning.replace(at, file.temporary_path().string().size(), "edits/wall_lines.geojson");
    }
  }
  std::error_code error;
  if (fs::is_regular_file(edit(), error) && read_text_file(edit()) != text) {
    keep_copy();
  }
  file.commit();
  return result;
}

/// A second name for the edit's bytes, so that the edit is never without one; a copy where a file system has
/// no links.
fs::path EditStore::keep_copy() const {
  const fs::path old = fs::path("edits") / "old";
  std::error_code error;
  fs::create_directories(work_ / old, error);
  for (int n = 1;; ++n) {
    const fs::path name = old / ("wall_lines." + std::to_string(n) + ".geojson");
    if (fs::exists(fs::symlink_status(work_ / name, error))) {
      continue;
    }
    fs::create_hard_link(edit(), work_ / name, error);
    if (error && error != std::errc::file_exists) {
      fs::copy_file(edit(), work_ / name, error);
    }
    if (!error) {
      return name;
    }
    if (error != std::errc::file_exists) {
      throw StageError(errors::kCannotWrite, (work_ / name).string(), error.message(),
                       "make room or give permission; the edit in force is untouched");
    }
  }
}

std::optional<fs::path> EditStore::drop() {
  const std::scoped_lock lock(mutex_);
  std::error_code error;
  if (!fs::is_regular_file(edit(), error)) {
    return std::nullopt;
  }
  fs::path name = keep_copy();
  fs::remove(edit(), error);
  if (error) {
    throw StageError(errors::kCannotWrite, edit().string(), error.message(), "give permission");
  }
  return name;
}

}  // namespace roomcut::view
