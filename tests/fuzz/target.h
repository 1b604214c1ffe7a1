// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace roomcut::fuzz {

/// How libFuzzer changes the inputs of a target.
enum class Mutation {
  kBytes,      ///< as it likes
  kJson,       ///< half of the time a node of the tree (json_mutator.h)
  kHdf5Edits,  ///< edits of a sound artefact, one a line (hdf5_edits.h)
};

/// One reader under fuzz. `feed` gives it the bytes; StageError is the documented answer to wrong ones, any
/// other exception, and whatever the sanitizers see, is a finding.
struct Target {
  std::string_view name;
  Mutation mutation;
  void (*feed)(std::string_view bytes);
  std::string_view
      seed;  ///< the artefact of a sound run that it starts from, relative to seeds(); may be empty
};

/// All targets, one for each reader of a file.
std::span<const Target> targets();
/// nullptr when there is none of that name.
const Target* find_target(std::string_view name);

/// Gives the bytes to the target: the code of the first problem that it answers with, e.g. "A02"; "ok" when
/// it takes them. Throws what the reader throws but StageError; std::logic_error when an error has no hint.
std::string answer(const Target& target, std::string_view bytes);

/// Folder of a sound run, from the environment's ROOMCUT_FUZZ_SEEDS (fuzz.py makes it).
std::filesystem::path seeds();

/// The bytes as a file of their own, for readers that take a path; gone with this object.
class PrivateFile {
 public:
  explicit PrivateFile(std::string_view bytes, std::string_view ending = "");
  ~PrivateFile();
  PrivateFile(const PrivateFile&) = delete;
  PrivateFile& operator=(const PrivateFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A folder of this process alone, below TMPDIR, where PrivateFile and scratch files lie.
const std::filesystem::path& private_folder();

// The targets by subject; target.cpp lists them.
std::span<const Target> scan_targets();
std::span<const Target> hdf5_targets();
std::span<const Target> json_targets();
std::span<const Target> text_targets();

}  // namespace roomcut::fuzz
