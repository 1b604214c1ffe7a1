// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/atomic_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <memory>
#include <system_error>

#include "common/artefact/unsynced_file.h"
#include "common/errors/codes.h"

namespace roomcut {

namespace fs = std::filesystem;

namespace {

/// Paths that a signal handler may have to remove; plain memory, since a handler may not touch the heap.
struct Registered {
  std::atomic<bool> taken{false};
  std::atomic<bool> ready{false};
  std::array<char, 4096> path{};
};
std::array<Registered, 16> registry;

void register_temporary(const fs::path& path) {
  const std::string& text = path.native();
  for (Registered& slot : registry) {
    if (text.size() + 1 <= slot.path.size() && !slot.taken.exchange(true)) {
      std::memcpy(slot.path.data(), text.c_str(), text.size() + 1);
      slot.ready.store(true);
      return;
    }
  }
}

void forget_temporary(const fs::path& path) {
  for (Registered& slot : registry) {
    if (slot.ready.load() && path.native() == slot.path.data()) {
      slot.ready.store(false);
      slot.taken.store(false);
      return;
    }
  }
}

[[noreturn]] void cannot_write(const fs::path& path, const std::string& action, int why) {
  std::string hint =
      "see whether the disk is sound, or choose another folder with WORK= or --work; nothing of before is "
      "lost";
  if (why == ENOSPC || why == EDQUOT || why == EFBIG) {
    hint = "free some space, or choose another folder with WORK= or --work; nothing of before is lost";
  } else if (why == EACCES || why == EPERM || why == EROFS) {
    hint = "choose a folder that you may write, with WORK= or --work";
  }
  throw StageError(errors::kCannotWrite, path.string(), action + ": " + std::strerror(why), hint);
}

/// The process id in ".<name>.<pid>.tmp", or 0.
pid_t writer_of(const std::string& file, const std::string& name) {
  const std::string head = "." + name + ".";
  const std::string tail = ".tmp";
  if (file.size() <= head.size() + tail.size() || !file.starts_with(head) || !file.ends_with(tail)) {
    return 0;
  }
  pid_t pid = 0;
  const char* end = file.data() + file.size() - tail.size();
  const auto [stop, error] = std::from_chars(file.data() + head.size(), end, pid);
  return error == std::errc() && stop == end ? pid : 0;
}

/// Also for a zombie, which no longer writes: in a container nobody may ever collect it.
bool is_dead(pid_t pid) {
  if (::kill(pid, 0) != 0) {
    return errno == ESRCH;
  }
  std::ifstream status("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(status, text);
  const std::size_t name_end = text.rfind(") ");
  return name_end != std::string::npos && name_end + 2 < text.size() &&
         (text[name_end + 2] == 'Z' || text[name_end + 2] == 'X');
}

void remove_left_overs(const fs::path& folder, const std::string& name) {
  // Not std::filesystem::directory_iterator, which ends the process when memory runs out.
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(::opendir(folder.c_str()), ::closedir);
  while (const dirent* const entry = entries ? ::readdir(entries.get()) : nullptr) {
    const pid_t pid = writer_of(entry->d_name, name);
    if (pid > 0 && pid != ::getpid() && is_dead(pid)) {
      std::error_code ignored;
      fs::remove(folder / entry->d_name, ignored);
    }
  }
}

/// fsync by path: HDF5 does not show its descriptor, and the pages belong to the file, not to the descriptor.
void sync_path(const fs::path& path, const fs::path& shown, int flags) {
  const int file = ::open(path.c_str(), flags | O_CLOEXEC);
  if (file < 0) {
    cannot_write(shown, "cannot be opened for writing out", errno);
  }
  const int status = ::fsync(file);
  const int why = errno;
  ::close(file);
  // Some file systems refuse fsync of a folder; the rename is still atomic there.
  if (status != 0 && why != EINVAL) {
    cannot_write(shown, "cannot be written out", why);
  }
}

void put_in_place(const fs::path& temporary, const fs::path& path) {
  if (::rename(temporary.c_str(), path.c_str()) != 0) {
    cannot_write(path, "cannot be put in place", errno);
  }
}

/// A rename would put a file in place of a device or a pipe: for root even of /dev/null.
void require_replaceable(const fs::path& path) {
  struct stat there {};
  if (::stat(path.c_str(), &there) == 0 && !S_ISREG(there.st_mode)) {
    throw StageError(errors::kCannotWrite, path.string(),
                     S_ISDIR(there.st_mode) ? "is a folder" : "is a device or a pipe, and is not replaced",
                     "name a file, in a folder that you may write");
  }
}

}  // namespace

AtomicFile::AtomicFile(fs::path final_path) : final_(std::move(final_path)) {
  const fs::path folder = final_.has_parent_path() ? final_.parent_path() : fs::path(".");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    cannot_write(folder, "the folder cannot be made", error.value());
  }
  require_replaceable(final_);
  const std::string name = final_.filename().string();
  remove_left_overs(folder, name);
  temporary_ = folder / ("." + name + "." + std::to_string(::getpid()) + ".tmp");
  register_temporary(temporary_);
  const int file = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) {
    const int why = errno;
    forget_temporary(temporary_);
    cannot_write(final_, "cannot be written", why);
  }
  ::close(file);
}

AtomicFile::~AtomicFile() {
  if (!committed_) {
    ::unlink(temporary_.c_str());
    forget_temporary(temporary_);
  }
}

void AtomicFile::write(std::string_view bytes) const {
  const int out = ::open(temporary_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (out < 0) {
    cannot_write(final_, "cannot be written", errno);
  }
  while (!bytes.empty()) {
    const ssize_t wrote = ::write(out, bytes.data(), bytes.size());
    if (wrote < 0 && errno == EINTR) {
      continue;
    }
    if (wrote < 0) {
      const int why = errno;
      ::close(out);
      cannot_write(final_, "cannot be written", why);
    }
    bytes.remove_prefix(static_cast<std::size_t>(wrote));
  }
  if (::close(out) != 0) {
    cannot_write(final_, "cannot be written", errno);
  }
}

void AtomicFile::start_writing_out() const noexcept {
  const int file = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file >= 0) {  // else nothing is lost but time
    ::sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE);
    ::close(file);
  }
}

void AtomicFile::commit(bool keep_time) {
  if (keep_time) {
    struct stat old {};
    if (::stat(final_.c_str(), &old) == 0) {
      const std::array<timespec, 2> times{old.st_atim, old.st_mtim};
      if (::utimensat(AT_FDCWD, temporary_.c_str(), times.data(), 0) != 0) {
        cannot_write(final_, "its time stamp cannot be set", errno);
      }
    }
  }
  sync_path(temporary_, final_, O_RDONLY);
  put_in_place(temporary_, final_);
  committed_ = true;
  forget_temporary(temporary_);
  const fs::path folder = final_.has_parent_path() ? final_.parent_path() : fs::path(".");
  sync_path(folder, final_, O_RDONLY | O_DIRECTORY);
}

bool write_text_file(const fs::path& path, std::string_view text) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (!error && size == text.size() && fs::is_regular_file(path, error) && read_text_file(path) == text) {
    return false;
  }
  AtomicFile file(path);
  file.write(text);
  file.commit();
  return true;
}

void write_unsynced_file(const fs::path& path, std::string_view text) {
  const AtomicFile file(path);  // never committed: its destructor then finds nothing to remove
  file.write(text);
  put_in_place(file.temporary_path(), path);
}

std::string read_text_file(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    throw StageError(errors::kArtefactMissing, path.string(),
                     std::string("cannot be opened: ") + std::strerror(errno));
  }
  std::string text;
  struct stat status {};
  if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode)) {
    text.reserve(static_cast<std::size_t>(status.st_size));
  }
  std::array<char, 65536> block{};
  ssize_t got = 0;
  while ((got = ::read(file, block.data(), block.size())) != 0) {
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      const int why = errno;
      ::close(file);
      throw StageError(errors::kArtefactMissing, path.string(),
                       std::string("cannot be read: ") + std::strerror(why));
    }
    text.append(block.data(), static_cast<std::size_t>(got));
  }
  ::close(file);
  return text;
}

void remove_temporary_files() noexcept {
  for (Registered& slot : registry) {
    if (slot.ready.load()) {
      ::unlink(slot.path.data());
    }
  }
}

}  // namespace roomcut
