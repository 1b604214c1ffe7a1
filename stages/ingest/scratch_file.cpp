// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scratch_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "common/errors/codes.h"
#include "common/errors/error.h"

namespace roomcut::ingest {

namespace {

[[noreturn]] void scratch_failed(const std::filesystem::path& folder) {
  const std::string reason = std::generic_category().message(errno);
  throw StageError(errors::kCannotWrite, folder.string(),
                   "the scratch file for points cannot be written: " + reason,
                   "free some space there (12 bytes per point), or raise --memory-mib");
}

int make_scratch_file(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::string name = (folder / ".ingest.XXXXXX").string();
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor >= 0) {
    ::unlink(name.c_str());  // it goes with the process, however that ends
  }
  return descriptor;
}

}  // namespace

ScratchFile::~ScratchFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

void ScratchFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  std::call_once(made_, [&] { descriptor_ = make_scratch_file(folder_); });
  if (descriptor_ < 0) {
    scratch_failed(folder_);
  }
  while (!bytes.empty()) {
    const ssize_t wrote = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (wrote < 0 && errno == EINTR) {
      continue;
    }
    if (wrote <= 0) {
      scratch_failed(folder_);
    }
    bytes = bytes.subspan(static_cast<std::size_t>(wrote));
    offset += static_cast<std::uint64_t>(wrote);
  }
}

void ScratchFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
  if (got != static_cast<ssize_t>(bytes.size())) {
    scratch_failed(folder_);
  }
}

}  // namespace roomcut::ingest
