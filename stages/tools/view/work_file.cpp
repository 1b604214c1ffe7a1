// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/work_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace roomcut::view {

OpenFile::~OpenFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

OpenFile& OpenFile::operator=(OpenFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

std::optional<std::uint64_t> OpenFile::size() const {
  struct stat status {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
    return std::nullopt;
  }
  return static_cast<std::uint64_t>(status.st_size);
}

bool OpenFile::read(std::uint64_t offset, char* bytes, std::size_t count) const {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t part = ::pread(descriptor_, bytes + done, count - done, static_cast<off_t>(offset + done));
    if (part < 0 && errno == EINTR) {
      continue;
    }
    if (part <= 0) {
      return false;
    }
    done += static_cast<std::size_t>(part);
  }
  return true;
}

std::optional<OpenFile> open_work_file(const std::filesystem::path& work, const ServedFile& file) {
  constexpr int kFolder = O_RDONLY | O_DIRECTORY | O_CLOEXEC;
  const OpenFile top(::open(work.c_str(), kFolder));
  const OpenFile folder(
      ::openat(top.descriptor(), file.folder.empty() ? "." : file.folder.c_str(), kFolder | O_NOFOLLOW));
  OpenFile opened(
      ::openat(folder.descriptor(), file.name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!opened.size()) {
    return std::nullopt;
  }
  return opened;
}

}  // namespace roomcut::view
