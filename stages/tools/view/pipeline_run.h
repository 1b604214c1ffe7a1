// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "stages/tools/view/run_progress.h"

namespace roomcut::view {

/// Runs a command (the pipeline) in a process group of its own, one at a time, and follows what it prints.
class PipelineRun {
 public:
  explicit PipelineRun(std::vector<std::string> command) : command_(std::move(command)) {}
  ~PipelineRun() { stop(); }
  PipelineRun(const PipelineRun&) = delete;
  PipelineRun& operator=(const PipelineRun&) = delete;

  /// False when it is running already. Throws std::system_error when the command cannot be started.
  bool start();
  RunProgress progress() const;
  /// Ends a running command by SIGTERM to its group (the pipeline then resumes at the stage that was at
  /// work) and waits for it.
  void stop();

 private:
  void follow(int pipe, pid_t child);

  std::vector<std::string> command_;
  mutable std::mutex mutex_;
  RunProgress progress_;
  pid_t child_ = -1;
  std::thread follower_;
};

}  // namespace roomcut::view
