// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace roomcut {

/// What a stage's process returns (schemas/errors.md).
enum class ExitCode : int {
  kDone = 0,
  kBug = 1,       ///< unexpected exception, failed invariant
  kUsage = 2,     ///< command line or parameter
  kInput = 3,     ///< missing, unreadable, wrong input or hand edit
  kNoResult = 4,  ///< the data allow no result
  kOutput = 5,    ///< cannot write, disk full
};

/// One entry of the error catalogue. All entries stand in codes.h; each has a paragraph in schemas/errors.md.
struct ErrorCode {
  const char* id;      ///< e.g. "C03"
  ExitCode exit_code;  ///< what the process returns when this error stops it
};

/// One thing that is wrong: `error[ID] where: what`, below it `hint: …`.
struct Problem {
  ErrorCode code;
  std::string where;  ///< file, and the place in it if there is one: "edits/wall_lines.geojson: features[17]"
  std::string what;   ///< cause, one sentence, no full stop
  std::string hint;   ///< remedy; may be empty
};

/// The lines printed for a problem, ending in a line break.
std::string to_string(const Problem& problem);

/// The only exception that stages throw on purpose; caught once, in run_stage() (common/cli).
/// Carries one problem or, for hand-edited files, all problems of the file. The exit code is the first
/// problem's.
class StageError : public std::runtime_error {
 public:
  explicit StageError(std::vector<Problem> problems);
  StageError(ErrorCode code, std::string where, std::string what, std::string hint = "");

  const std::vector<Problem>& problems() const { return problems_; }
  ExitCode exit_code() const { return problems_.front().code.exit_code; }

 private:
  std::vector<Problem> problems_;
};

}  // namespace roomcut
