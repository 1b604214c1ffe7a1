// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace roomcut {

/// A program whose standard output is read here; its standard error is kept aside. It ends with this process,
/// however that ends.
class DecoderProcess {
 public:
  /// Starts command[0] with its arguments. Errors: std::system_error.
  explicit DecoderProcess(const std::vector<std::string>& command);
  ~DecoderProcess();
  DecoderProcess(const DecoderProcess&) = delete;
  DecoderProcess& operator=(const DecoderProcess&) = delete;

  /// Fills `bytes` from its output; returns how many there were, fewer only at its end.
  std::size_t read(std::span<std::byte> bytes);
  /// Waits for its end. Returns "" when it returned 0, otherwise in words how it ended, with the last line of
  /// its standard error.
  std::string finish();

 private:
  std::string last_error_line() const;

  pid_t process_ = -1;
  int output_ = -1;
  int errors_ = -1;
};

}  // namespace roomcut
