// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "common/errors/codes.h"

namespace roomcut::ingest {

namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

[[noreturn]] void cannot_open(const std::filesystem::path& path, int error) {
  if (error == ENOENT || error == ENOTDIR) {
    throw StageError(errors::kScanMissing, path.string(), "there is no such file",
                     "check the name given as SCAN");
  }
  throw StageError(errors::kScanUnreadable, path.string(), "cannot be opened: " + reason(error),
                   "check who may read the file and its folders");
}

}  // namespace

ScanFile::ScanFile(const std::filesystem::path& path) : path_(path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {  // before open(): opening a pipe would wait for a writer
    cannot_open(path, errno);
  }
  if (S_ISDIR(status.st_mode)) {
    throw StageError(errors::kScanMissing, name(), "is a folder, not a point cloud file",
                     "name the file in it");
  }
  if (!S_ISREG(status.st_mode)) {
    throw StageError(errors::kScanUnreadable, name(), "is no regular file",
                     "write the points to a file first: they are read from several places at once");
  }
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) {
    cannot_open(path, errno);
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  if (size_ == 0) {
    ::close(descriptor_);
    throw StageError(errors::kScanEmpty, name(), "the file is empty (0 bytes)",
                     "export or copy the scan again");
  }
}

ScanFile::~ScanFile() {
  ::close(descriptor_);
}

std::size_t ScanFile::read(std::uint64_t offset, void* out, std::size_t bytes) const {
  if (offset >= size_) {
    return 0;
  }
  const std::size_t wanted = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, size_ - offset));
  std::size_t done = 0;
  while (done < wanted) {
    const ssize_t got = ::pread(descriptor_, static_cast<char*>(out) + done, wanted - done,
                                static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      throw StageError(errors::kScanUnreadable, name(), "cannot be read: " + reason(errno),
                       "copy the scan to a sound disk");
    }
    if (got == 0) {
      throw StageError(errors::kScanTruncated, name(), "the file became shorter while it was read",
                       "wait until it is written completely");
    }
    done += static_cast<std::size_t>(got);
  }
  return done;
}

}  // namespace roomcut::ingest
