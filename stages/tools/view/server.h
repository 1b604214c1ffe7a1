// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace roomcut::view {

/// Serves one work folder over HTTP on the loopback interface only. What may be asked for and what is
/// refused: README.md of this folder and request_rules.h.
class ViewServer {
 public:
  /// `pipeline`: the command that POST api/run starts.
  ViewServer(std::filesystem::path work, std::vector<std::string> pipeline);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Binds 127.0.0.1:`port`, 0 = any free one; returns the port. Throws StageError(kUsage) when it is taken.
  int bind(int port);
  /// Answers requests until stop() is called by another thread.
  void serve();
  /// Also ends a run of the pipeline.
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roomcut::view
