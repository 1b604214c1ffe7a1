// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/known_artefacts.h"

#include <sys/stat.h>

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace roomcut {

namespace {

/// Another file, or the same one with another content, has another state.
using FileState = std::array<std::uint64_t, 5>;

std::optional<FileState> state_of(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    return std::nullopt;
  }
  return FileState{static_cast<std::uint64_t>(status.st_dev), static_cast<std::uint64_t>(status.st_ino),
                   static_cast<std::uint64_t>(status.st_size),
                   static_cast<std::uint64_t>(status.st_mtim.tv_sec),
                   static_cast<std::uint64_t>(status.st_mtim.tv_nsec)};
}

struct Noted {
  FileState state;
  InputRecord stated;
};

struct Notes {
  std::mutex mutex;
  std::map<std::string, Noted> by_path;
};

Notes& notes() {
  static Notes all;
  return all;
}

}  // namespace

void remember_artefact(const std::filesystem::path& path, const InputRecord& stated) {
  if (const std::optional<FileState> state = state_of(path)) {
    const std::scoped_lock lock(notes().mutex);
    notes().by_path[path.native()] = {*state, stated};
  }
}

std::optional<InputRecord> known_artefact(const std::filesystem::path& path) {
  const std::optional<FileState> state = state_of(path);
  const std::scoped_lock lock(notes().mutex);
  const auto found = notes().by_path.find(path.native());
  if (!state || found == notes().by_path.end() || found->second.state != *state) {
    return std::nullopt;
  }
  return found->second.stated;
}

}  // namespace roomcut
