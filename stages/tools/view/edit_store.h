// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace roomcut::view {

/// What an edit that was taken in changes.
struct AcceptedEdit {
  std::vector<std::string> changes;   ///< as describe_changes() words them
  std::vector<std::string> warnings;  ///< of the reader
};

/// The hand edit of a work folder. Thread-safe within the process.
class EditStore {
 public:
  explicit EditStore(std::filesystem::path work) : work_(std::move(work)) {}

  /// The edit in force; nullopt when there is none.
  std::optional<std::string> read() const;
  /// Whether there is one. Does not wait for an edit that is being taken in.
  bool exists() const;
  /// Takes `text` for edits/wall_lines.geojson when read_edited_wall_lines() has nothing against it: written
  /// beside, checked, the former edit kept as edits/old/wall_lines.<n>.geojson, moved into place. Throws
  /// StageError with all problems; then nothing is changed.
  AcceptedEdit accept(const std::string& text);
  /// Moves the edit to edits/old/ and returns its name there, relative to the work folder; nullopt when
  /// there is none.
  std::optional<std::filesystem::path> drop();

 private:
  std::filesystem::path edit() const { return work_ / "edits" / "wall_lines.geojson"; }
  std::filesystem::path keep_copy() const;

  std::filesystem::path work_;
  mutable std::mutex mutex_;
};

}  // namespace roomcut::view
