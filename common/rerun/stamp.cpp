// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/rerun/stamp.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <sstream>

#include "common/artefact/atomic_file.h"
#include "common/artefact/unsynced_file.h"
#include "common/errors/codes.h"
#include "common/rerun/file_state.h"
#include "common/rerun/work_digests.h"

namespace roomcut {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kHead = "roomcut stamp 2";
constexpr std::string_view kEnd = "end";

fs::path before_of(const fs::path& stamp) {
  return stamp.string() + ".before";
}

const StampEntry* find(const std::vector<StampEntry>& entries, const std::string& name) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const StampEntry& e) { return e.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

bool stays_inside(const fs::path& name) {
  return name.is_relative() && !name.empty() &&
         std::none_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
}

/// "in DIGEST NAME" or "out DIGEST CONTENT NAME".
bool take_line(const std::string& line, Stamp& stamp) {
  std::istringstream words(line);
  std::string kind;
  StampEntry entry;
  words >> kind >> entry.sha256;
  if (kind == "out") {
    words >> entry.content;
  }
  if (!words || words.get() != ' ' || !std::getline(words, entry.name) || !stays_inside(entry.name) ||
      (kind != "in" && kind != "out")) {
    return false;
  }
  (kind == "in" ? stamp.inputs : stamp.outputs).push_back(std::move(entry));
  return true;
}

/// Whether `text` is a whole stamp; it then is in `stamp`.
bool parse(const std::string& text, Stamp& stamp) {
  std::istringstream lines(text);
  std::string line;
  if (!std::getline(lines, line) || line != kHead) {
    return false;
  }
  while (std::getline(lines, line) && line != kEnd) {
    if (!take_line(line, stamp)) {
      return false;
    }
  }
  return line == kEnd && !stamp.outputs.empty();
}

std::string to_text(const Stamp& stamp) {
  std::ostringstream text;
  text << kHead << '\n';
  for (const StampEntry& entry : stamp.inputs) {
    text << "in " << entry.sha256 << ' ' << entry.name << '\n';
  }
  for (const StampEntry& entry : stamp.outputs) {
    text << "out " << entry.sha256 << ' ' << entry.content << ' ' << entry.name << '\n';
  }
  text << kEnd << '\n';
  return text.str();
}

bool same_payloads(const Stamp& before, const Stamp& now) {
  return std::all_of(now.outputs.begin(), now.outputs.end(), [&](const StampEntry& entry) {
    const StampEntry* old = find(before.outputs, entry.name);
    return old != nullptr && old->sha256 == entry.sha256;
  });
}

fs::path mark_of(const fs::path& stamp) {
  return stamp.parent_path() / ("." + stamp.filename().string() + ".changed");
}

}  // namespace

StampFile read_stamp(const fs::path& stamp) {
  StampFile file;
  const bool there = file_state(stamp).has_value();
  if (!there && !file_state(before_of(stamp))) {
    return file;
  }
  const bool whole = parse(read_text_file(there ? stamp : before_of(stamp)), file.stamp);
  file.state = !there ? StampState::kUnfinished : whole ? StampState::kWhole : StampState::kUnknown;
  if (!whole) {
    file.stamp = {};
  }
  return file;
}

std::vector<std::string> changed_inputs(const Stamp& stamp, const std::vector<std::string>& reads,
                                        const DigestOf& digest_of) {
  std::vector<std::string> changed;
  for (const std::string& name : reads) {
    const StampEntry* then = find(stamp.inputs, name);
    if (then == nullptr) {
      changed.push_back(name);
      continue;
    }
    const std::string now = digest_of(name);
    const bool scan_is_gone = name == kScanName && now == kNoFile;
    if (now != then->sha256 && !scan_is_gone) {
      changed.push_back(name);
    }
  }
  return changed;
}

void withdraw_stamp(const fs::path& stamp) {
  if (::rename(stamp.c_str(), before_of(stamp).c_str()) != 0 && errno != ENOENT) {
    throw StageError(errors::kCannotWrite, stamp.string(),
                     std::string("cannot be moved aside: ") + std::strerror(errno),
                     "choose a folder that you may write, with WORK=");
  }
}

void settle_stamp(const fs::path& stamp, const Stamp& content) {
  if (!same_payloads(read_stamp(stamp).stamp, content)) {
    mark_changed(stamp);
  }
  write_unsynced_file(stamp, to_text(content));
  std::error_code ignored;
  fs::remove(before_of(stamp), ignored);
}

void mark_changed(const fs::path& stamp) {
  write_unsynced_file(mark_of(stamp), "changed\n");
}

void unmark_changed(const fs::path& stamp) {
  std::error_code error;
  fs::remove(mark_of(stamp), error);
  if (error) {
    throw StageError(errors::kCannotWrite, mark_of(stamp).string(), "cannot be removed: " + error.message(),
                     "choose a folder that you may write, with WORK=");
  }
}

}  // namespace roomcut
