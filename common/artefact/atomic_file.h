// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace roomcut {

/// A file written beside its final place (same folder, ".<name>.<pid>.tmp") and moved there only when
/// complete: a process killed at any moment leaves the final name untouched. Left-overs of dead processes are
/// removed by the next writer of the same name. The destructor removes the temporary file when commit() was
/// not reached.
class AtomicFile {
 public:
  /// Creates the parent folder when missing. Throws StageError(kCannotWrite), also for a final path that is a
  /// folder, a device or a pipe.
  explicit AtomicFile(std::filesystem::path final_path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary_path() const { return temporary_; }
  const std::filesystem::path& final_path() const { return final_; }

  /// Appends `bytes` to the temporary file. Throws StageError(kCannotWrite).
  void write(std::string_view bytes) const;

  /// Lets the system begin to write out what is in the temporary file, and does not wait: commit() then waits
  /// for the rest only.
  void start_writing_out() const noexcept;

  /// fsync of the file, rename, fsync of the folder. With `keep_time` the file takes over the modification
  /// time of the one that it replaces: for people, nothing is new. Throws StageError(kCannotWrite).
  void commit(bool keep_time = false);

 private:
  std::filesystem::path final_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// Writes `text` through an AtomicFile; an existing file with the same bytes is left as it is. Returns
/// whether it wrote.
bool write_text_file(const std::filesystem::path& path, std::string_view text);

/// The whole file. Throws StageError(kArtefactMissing) when it cannot be read.
std::string read_text_file(const std::filesystem::path& path);

/// Removes the temporary files of this process. Async-signal-safe: for the handlers of SIGINT and SIGTERM.
void remove_temporary_files() noexcept;

}  // namespace roomcut
