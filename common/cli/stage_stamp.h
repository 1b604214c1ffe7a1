// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/cli/run_stage.h"
#include "common/rerun/file_state.h"

namespace roomcut {

/// A stage's side of a rerun that is decided by content (common/rerun): what it read and what it wrote goes
/// into its stamp. The stage does it itself because another process would cost as much as a small stage.
/// Names are relative to the work folder, which must be the current one. Not for stages.
class StageStamp {
 public:
  /// `reads`: names of all that the stage is made from, separated by spaces; the first run of a stage on a
  /// scan names it kScanName.
  StageStamp(std::filesystem::path stamp, const std::string& reads);

  /// Whether the stage has run on just what lies there now, so that it need not run again.
  bool is_current() const;
  /// Before the stage reads anything: takes the digests of what enters from outside, which a person may
  /// change meanwhile, and moves the stamp of before aside. `scan`: the scan's file, empty when the stage
  /// reads none.
  void begin(const std::filesystem::path& scan);
  /// After the stage ran. Throws StageError when an output is missing or the stamp cannot be written.
  void settle(const StageRun& run, const std::vector<std::filesystem::path>& outputs) const;

 private:
  std::string input_digest(const std::string& name, const StageRun& run) const;

  std::filesystem::path stamp_;
  std::vector<std::string> reads_;
  std::map<std::string, std::string> from_outside_;
  std::optional<FileState> scan_state_;
  std::optional<FileSystemNow> begun_;
};

}  // namespace roomcut
