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

/// Files up to this size go by the digest of their bytes, larger ones by that of their payload, for which a
/// cloud's blocks are read at once. [bytes]
inline constexpr unsigned long long kWholeUpTo = 8U << 20;

/// Gives the payload digest of a file as its content has it.
using PayloadDigest = std::function<std::string(const std::filesystem::path&)>;

/// The digest by which a file that a stage wrote goes, computed. Throws what reading it throws.
std::string content_digest(const std::filesystem::path& path, const PayloadDigest& payload_of,
                           unsigned long long whole_up_to = kWholeUpTo);

/// What the files of the work folder hold now, by digest: of the bytes, whatever a file says of itself, or of
/// a large artefact's payload. A digest that was computed is remembered with the file's state, and computed
/// again unless the file still has just that state; so times can never make a changed file look unchanged,
/// and a copied or touched one is read once more.
class WorkDigests {
 public:
  /// Reads kDigestFile; a missing or damaged one remembers nothing.
  explicit WorkDigests(PayloadDigest payload_of, std::filesystem::path scan = {},
                       unsigned long long whole_up_to = kWholeUpTo);

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
  unsigned long long whole_up_to_;
  std::map<std::string, std::string> known_;  ///< name to "digest state"
  bool is_new_ = false;
};

/// Adds one line to kDigestFile, as WorkDigests::note(), for a stage that has written or read the file
/// itself. Several processes may do so at once.
void append_digest(const std::string& name, const FileState& state, const FileSystemNow& now,
                   const std::string& digest);

/// Whether a file enters from outside: the scan, edits/, inputs/, params/. These go by their bytes at any
/// size.
bool is_from_outside(const std::string& name);

}  // namespace roomcut
