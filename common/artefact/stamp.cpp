// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/stamp.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <set>
#include <sstream>

#include "common/artefact/h5.h"
#include "common/artefact/unsynced_file.h"
#include "common/errors/codes.h"

namespace roomcut {

namespace fs = std::filesystem;

std::vector<StampEntry> read_stamp(const fs::path& stamp) {
  std::error_code error;
  if (!fs::is_regular_file(stamp, error)) {
    return {};
  }
  std::istringstream text(read_text_file(stamp));
  std::vector<StampEntry> entries;
  std::string line;
  while (std::getline(text, line)) {
    std::istringstream words(line);
    StampEntry entry;
    std::string path;
    if (words >> entry.sha256 >> entry.seconds >> entry.nanoseconds && words.get() == ' ' &&
        std::getline(words, path)) {
      entry.path = path;
      entries.push_back(entry);
    }
  }
  return entries;
}

namespace {

const StampEntry* find(const std::vector<StampEntry>& entries, const fs::path& path) {
  for (const StampEntry& entry : entries) {
    if (entry.path == path) {
      return &entry;
    }
  }
  return nullptr;
}

void set_time(const StampEntry& entry) {
  timespec then{};
  then.tv_sec = entry.seconds;
  then.tv_nsec = entry.nanoseconds;
  const std::array<timespec, 2> times{then, then};
  if (::utimensat(AT_FDCWD, entry.path.c_str(), times.data(), 0) != 0) {
    throw StageError(errors::kCannotWrite, entry.path.string(),
                     std::string("its time stamp cannot be set: ") + std::strerror(errno));
  }
}

fs::path before_of(const fs::path& stamp) {
  return stamp.string() + ".before";
}

}  // namespace

void withdraw_stamp(const fs::path& stamp) {
  if (::rename(stamp.c_str(), before_of(stamp).c_str()) != 0 && errno != ENOENT) {
    throw StageError(errors::kCannotWrite, stamp.string(),
                     std::string("cannot be moved aside: ") + std::strerror(errno));
  }
}

void settle_stamp(const fs::path& stamp, const std::string& missing, const std::vector<fs::path>& outputs) {
  const fs::path before = before_of(stamp);
  const std::vector<StampEntry> old = read_stamp(before);
  std::set<std::string> were_missing;
  std::istringstream words(missing);
  for (std::string word; words >> word;) {
    were_missing.insert(word);
  }
  std::ostringstream text;
  for (const fs::path& output : outputs) {
    StampEntry entry;
    entry.path = output;
    entry.sha256 = inspect_artefact(output).payload_sha256;
    const StampEntry* last = find(old, output);
    if (last != nullptr && last->sha256 == entry.sha256 && were_missing.contains(output.string())) {
      set_time(*last);
    }
    struct stat status {};
    ::stat(output.c_str(), &status);
    entry.seconds = status.st_mtim.tv_sec;
    entry.nanoseconds = status.st_mtim.tv_nsec;
    text << entry.sha256 << ' ' << entry.seconds << ' ' << entry.nanoseconds << ' ' << entry.path.string()
         << '\n';
  }
  // Always a new file: a stamp says by its time when the stage ran.
  write_unsynced_file(stamp, text.str());
  std::error_code ignored;
  fs::remove(before, ignored);
}

}  // namespace roomcut
