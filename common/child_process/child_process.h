// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace roomcut {

/// A program that this process started and is joined to by one stream; its standard error is kept aside. It
/// ends with this process, however that ends. All but stop() is for one thread at a time.
class ChildProcess {
 public:
  enum class Stream {
    kOutput,  ///< what it prints is read here; it has nothing to read
    kInput,   ///< what it reads is written here; what it prints goes to its standard error
  };

  /// Starts command[0], a path, with its arguments. One that cannot be started is one that ends with 127.
  /// Errors: std::system_error.
  ChildProcess(std::vector<std::string> command, Stream stream);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Fills `bytes` from its output; returns how many there were, fewer only at its end, or when it stands
  /// still because somebody has stopped it.
  std::size_t read(std::span<std::byte> bytes);
  /// Whether its input took all bytes: one that has ended, or was stopped, takes none.
  bool write(std::span<const std::byte> bytes);
  /// Closes its input and waits for its end; ends it when it was stopped. Returns "" when it returned 0,
  /// otherwise in words how it ended, with the last line of its standard error.
  std::string finish();
  /// Ends it, so that read() comes to its end; from any thread.
  void stop() const;

 private:
  ChildProcess() = default;
  /// Waits until `descriptor` is ready for `events` (poll). False: the process is stopped.
  bool wait_for(int descriptor, short events) const;
  int reap();
  std::string last_error_line() const;

  pid_t process_ = -1;
  int handle_ = -1;  ///< pidfd: names the process even when it is gone
  int stream_ = -1;
  int errors_ = -1;
  bool is_input_ = false;
  bool stands_still_ = false;
};

}  // namespace roomcut
