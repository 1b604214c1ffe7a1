// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace roomcut {

/// A moment as a file system tells it, which need not be this machine's clock.
struct FileTime {
  long long seconds = 0;
  long long nanoseconds = 0;
  auto operator<=>(const FileTime&) const = default;
};

/// What changes whenever a file's content does. `changed` (ctime) is set by the system alone: neither touch
/// nor cp -a nor rsync can put it back.
struct FileState {
  unsigned long long device = 0;  ///< not compared: it may change when the machine starts anew
  unsigned long long inode = 0;
  unsigned long long size = 0;  ///< [bytes]
  FileTime modified, changed;
};

/// The state of the regular file at `path` (links are followed); none when there is none.
std::optional<FileState> file_state(const std::filesystem::path& path);

/// "inode size modified changed", the times as seconds.nanoseconds. Two states are the same when these texts
/// are.
std::string to_text(const FileState& state);

/// The present moment by the clock of the file system of `folder`: the ctime of a file that is touched there;
/// with the device. None when the folder cannot be written.
struct FileSystemNow {
  FileTime time;
  unsigned long long device = 0;
};
std::optional<FileSystemNow> file_system_now(const std::filesystem::path& folder);

/// Whether a later change of a file in this state, seen at `now` or later, must give it another state. Not so
/// for one that changed within the same tick of the clock (the racy case that git knows), which therefore
/// must not be remembered. On another file system, whose clock may be another and coarser, two seconds must
/// have passed.
bool is_settled(const FileState& state, const FileSystemNow& now);

}  // namespace roomcut
