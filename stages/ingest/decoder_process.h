// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace roomcut::ingest {

/// A program whose standard output is read here; its standard error is kept aside. It ends with this process,
/// however that ends. All but stop() is for one thread at a time.
class DecoderProcess {
 public:
  /// Starts command[0] with its arguments. Errors: std::system_error.
  explicit DecoderProcess(const std::vector<std::string>& command);
  ~DecoderProcess();
  DecoderProcess(const DecoderProcess&) = delete;
  DecoderProcess& operator=(const DecoderProcess&) = delete;

  /// Fills `bytes` from its output; returns how many there were, fewer only at its end, or when it stands
  /// still because somebody has stopped it.
  std::size_t read(std::span<std::byte> bytes);
  /// Waits for its end; ends it when it was stopped. Returns "" when it returned 0, otherwise in words how it
  /// ended, with the last line of its standard error.
  std::string finish();
  /// Ends it, so that read() comes to its end; from any thread.
  void stop() const;

 private:
  /// Waits until `descriptor` has something to say. False: the process is stopped.
  bool wait_for(int descriptor) const;
  std::string last_error_line() const;

  pid_t process_ = -1;
  int handle_ = -1;  ///< pidfd: names the process even when it is gone
  int output_ = -1;
  int errors_ = -1;
  bool stands_still_ = false;
};

}  // namespace roomcut::ingest
