// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/rerun/work_digests.h"

#include <fcntl.h>
#include <unistd.h>

#include <exception>
#include <optional>
#include <sstream>

#include "common/artefact/atomic_file.h"
#include "common/artefact/sha256.h"
#include "common/artefact/unsynced_file.h"
#include "common/errors/error.h"

namespace roomcut {

namespace fs = std::filesystem;

namespace {

constexpr const char* kUnreadable = "unreadable";

/// The name in "digest inode size modified changed name"; the names of a work folder hold no line breaks.
std::optional<std::pair<std::string, std::string>> name_and_rest(const std::string& line) {
  std::size_t end = 0;
  constexpr int kWords = 5;
  for (int word = 0; word < kWords; ++word) {
    end = line.find(' ', word == 0 ? 0 : end + 1);
    if (end == std::string::npos) {
      return std::nullopt;
    }
  }
  return std::pair{line.substr(end + 1), line.substr(0, end)};
}

}  // namespace

bool is_from_outside(const std::string& name) {
  return name == kScanName || name.starts_with("edits/") || name.starts_with("inputs/") ||
         name.starts_with("params/");
}

WorkDigests::WorkDigests(PayloadDigest payload_of, fs::path scan, unsigned long long whole_up_to)
    : payload_of_(std::move(payload_of)), scan_(std::move(scan)), whole_up_to_(whole_up_to) {
  if (!file_state(kDigestFile)) {
    return;
  }
  std::istringstream lines(read_text_file(kDigestFile));
  for (std::string line; std::getline(lines, line);) {
    if (auto entry = name_and_rest(line)) {
      is_new_ = known_.contains(entry->first) || is_new_;  // save() leaves one line a name
      known_[entry->first] = entry->second;                // the last line of a name is the newest
    }
  }
}

fs::path WorkDigests::path_of(const std::string& name) const {
  return name == kScanName ? scan_ : fs::path(name);
}

std::string content_digest(const fs::path& path, const PayloadDigest& payload_of,
                           unsigned long long whole_up_to) {
  const std::optional<FileState> state = file_state(path);
  return state && state->size <= whole_up_to ? sha256_of_file(path) : payload_of(path);
}

std::string WorkDigests::computed(const std::string& name) const {
  try {
    return is_from_outside(name) ? sha256_of_file(path_of(name))
                                 : content_digest(path_of(name), payload_of_, whole_up_to_);
  } catch (const std::exception&) {  // whatever a damaged file makes of its reader
    return kUnreadable;
  }
}

std::string WorkDigests::of(const std::string& name) {
  // The moment before the state, the state before the content: what changes later has another state.
  const std::optional<FileState> state = file_state(path_of(name));
  if (!state) {
    return kNoFile;
  }
  const auto found = known_.find(name);
  if (found != known_.end()) {
    const std::size_t space = found->second.find(' ');
    if (found->second.substr(space + 1) == to_text(*state)) {
      return found->second.substr(0, space);
    }
  }
  const std::optional<FileSystemNow> now = file_system_now(fs::path(kDigestFile).parent_path());
  const FileState seen = file_state(path_of(name)).value_or(*state);
  const std::string digest = computed(name);
  if (now && digest != kUnreadable) {
    note(name, seen, *now, digest);
  }
  return digest;
}

void WorkDigests::note(const std::string& name, const FileState& state, const FileSystemNow& now,
                       const std::string& digest) {
  if (is_settled(state, now)) {
    known_[name] = digest + " " + to_text(state);
    is_new_ = true;
  }
}

void WorkDigests::save() {
  if (!is_new_) {
    return;
  }
  std::string text;
  for (const auto& [name, rest] : known_) {
    text += rest + " " + name + "\n";
  }
  try {
    write_unsynced_file(kDigestFile, text);
  } catch (const StageError&) {  // a full disk: the stage that needs the room says so
    return;
  }
}

void append_digest(const std::string& name, const FileState& state, const FileSystemNow& now,
                   const std::string& digest) {
  if (!is_settled(state, now)) {
    return;
  }
  const std::string line = digest + " " + to_text(state) + " " + name + "\n";
  const int file = ::open(kDigestFile, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file >= 0) {
    // A line that does not fit on the disk is no line; the digest is then computed again.
    if (::write(file, line.data(), line.size()) != static_cast<ssize_t>(line.size())) {
      ::close(file);
      return;
    }
    ::close(file);
  }
}

}  // namespace roomcut
