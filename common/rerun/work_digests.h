// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "common/rerun/file_state.h"

namespace roomcut {

/// Names of a pipeline's files are relative to the work folder, which is the current one. The scan lies
/// elsewhere and goes by this name.
inline constexpr const char* kScanName = "scan";
/// Where a work folder keeps the digests of its files, each with the state that the file had.
inline constexpr const char* kDigestFile = "stamps/.digests";
/// What stands for the digest of a file that is not there.
inline constexpr const char* kNoFile = "none";

/// What the files of the work folder hold now, by digest: of the bytes for what enters from outside (the
/// scan, edits/, inputs/, params/), of the payload for artefacts. A digest that was computed is remembered
/// with the file's state, and computed again unless the file still has just that state; so times can never
/// make a changed file look unchanged, and a copied or touched one is read once more.
class WorkDigests {
 public:
  using PayloadDigest = std::function<std::string(const std::filesystem::path&)>;

  /// Reads kDigestFile; a missing or damaged one remembers nothing. `payload_of` gives the payload digest of
  /// a file as its content has it; StageErrors that it throws make the file one of kUnreadable.
  explicit WorkDigests(PayloadDigest payload_of, std::filesystem::path scan = {});

  /// The digest of `name`, kNoFile, or a text that is no digest when the file cannot be read.
  std::string of(const std::string& name);
  /// What `name` held when it had `state`, known from elsewhere. Kept only when the state was settled by
  /// then.
  void note(const std::string& name, const FileState& state, const FileSystemNow& now,
            const std::string& digest);
  /// Writes kDigestFile anew when digests were computed. Never throws: it only saves time.
  void save();

 private:
  std::filesystem::path path_of(const std::string& name) const;
  std::string computed(const std::string& name) const;

  PayloadDigest payload_of_;
  std::filesystem::path scan_;
  std::map<std::string, std::string> known_;  ///< name to "digest state"
  bool is_new_ = false;
};

/// Adds one line to kDigestFile, as WorkDigests::note(), for a stage that has written or read the file
/// itself. Several processes may do so at once.
void append_digest(const std::string& name, const FileState& state, const FileSystemNow& now,
                   const std::string& digest);

/// Whether a file goes by the digest of its bytes, whatever it says of itself.
bool is_taken_by_bytes(const std::string& name);

}  // namespace roomcut
