// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/rerun/file_state.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdio>

namespace roomcut {

namespace {

FileTime time_of(const timespec& time) {
  return {time.tv_sec, time.tv_nsec};
}

}  // namespace

std::optional<FileState> file_state(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) {
    return std::nullopt;
  }
  return FileState{status.st_dev, status.st_ino, static_cast<unsigned long long>(status.st_size),
                   time_of(status.st_mtim), time_of(status.st_ctim)};
}

std::string to_text(const FileState& state) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%llu %llu %lld.%09lld %lld.%09lld", state.inode, state.size,
                state.modified.seconds, state.modified.nanoseconds, state.changed.seconds,
                state.changed.nanoseconds);
  return text.data();
}

std::optional<FileSystemNow> file_system_now(const std::filesystem::path& folder) {
  const std::filesystem::path clock = folder / ".clock";
  const int file = ::open(clock.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file < 0) {
    return std::nullopt;
  }
  struct stat status {};
  const bool told = ::futimens(file, nullptr) == 0 && ::fstat(file, &status) == 0;
  ::close(file);
  return told ? std::optional(FileSystemNow{time_of(status.st_ctim), status.st_dev}) : std::nullopt;
}

bool is_settled(const FileState& state, const FileSystemNow& now) {
  constexpr long long kOtherClock_s = 2;
  const FileTime limit{now.time.seconds - (state.device == now.device ? 0 : kOtherClock_s),
                       now.time.nanoseconds};
  return state.changed < limit;
}

}  // namespace roomcut
