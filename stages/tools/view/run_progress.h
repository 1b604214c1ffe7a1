// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <optional>
#include <string>

namespace roomcut::view {

/// Where a run of the pipeline stands, from the lines that it prints.
struct RunProgress {
  static constexpr std::size_t kLogLines = 200;

  bool running = false;
  std::string stage;            ///< the one at work; "" before the first and after the last
  int done = 0, of = 0;         ///< stages before it, stages of the pipeline
  std::deque<std::string> log;  ///< the last kLogLines lines
  std::string error;            ///< first error with its hint; "" = none
  std::optional<int> exit_code;

  void start();
  /// One line without its end. "@stage 7 15 raycast" says that the seventh of fifteen stages begins (such
  /// lines are asked for by ROOMCUT_PROGRESS, stages/pipeline.mk); all others go to the log.
  void add_line(const std::string& line);
  void finish(int code);
};

}  // namespace roomcut::view
