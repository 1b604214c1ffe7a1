// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace roomcut {

/// A file that a stage read or wrote, as it was then.
struct StampEntry {
  /// The payload digest of an artefact: what follows runs again only when this changes. Of other files the
  /// digest of their bytes; kNoFile for an optional one that was not there.
  std::string sha256;
  std::string name;     ///< relative to the work folder, i.e. the current folder; or kScanName
  std::string content;  ///< outputs only: what WorkDigests says of the file as it was written
};

/// What a stage that has run leaves in stamps/<name>: by digest, all that it was made from and all that it
/// made.
struct Stamp {
  std::vector<StampEntry> inputs;
  std::vector<StampEntry> outputs;
};

enum class StampState {
  kWhole,
  kNone,        ///< the stage never ran
  kUnfinished,  ///< it began and did not end: there is the stamp of the run before, moved aside
  kUnknown      ///< there is one that does not say all: of an older roomcut, or cut short by a loss of power
};

struct StampFile {
  StampState state = StampState::kNone;
  Stamp stamp;  ///< of kUnfinished the one of before; empty when there is none
};

/// Reads stamps/<name>. Names in it that lead out of the work folder make it kUnknown.
StampFile read_stamp(const std::filesystem::path& stamp);

/// The digest that a file has now, by name.
using DigestOf = std::function<std::string(const std::string&)>;

/// Those of `reads` that are not what the stamp's run read, or that it did not read at all. A scan that is
/// gone is taken for unchanged: what was made from it stays.
std::vector<std::string> changed_inputs(const Stamp& stamp, const std::vector<std::string>& reads,
                                        const DigestOf& digest_of);

/// Before a stage runs: `stamp` becomes `<stamp>.before`, so that a stage that is killed leaves none. Throws
/// StageError(kCannotWrite).
void withdraw_stamp(const std::filesystem::path& stamp);

/// After a stage ran: puts `content` in place of `stamp` and removes `<stamp>.before`. When an output's
/// payload is not that of before, mark_changed() comes first. Throws StageError(kCannotWrite).
void settle_stamp(const std::filesystem::path& stamp, const Stamp& content);

/// Leaves the mark, stamps/.<name>.changed, that tells Make in this run that whoever reads the stage's
/// outputs must look whether they are still what it read. Throws StageError(kCannotWrite).
void mark_changed(const std::filesystem::path& stamp);

/// Takes away the mark of the run before. Throws StageError(kCannotWrite).
void unmark_changed(const std::filesystem::path& stamp);

}  // namespace roomcut
