// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace roomcut::synthesize {

/// A program whose standard input is written here; its standard error is kept aside. It ends with this
/// process, however that ends.
class EncoderProcess {
 public:
  /// Starts command[0] with its arguments. Errors: std::system_error.
  explicit EncoderProcess(const std::vector<std::string>& command);
  ~EncoderProcess();
  EncoderProcess(const EncoderProcess&) = delete;
  EncoderProcess& operator=(const EncoderProcess&) = delete;

  /// Whether all bytes were taken: a program that has ended takes none.
  bool write(const void* data, std::size_t bytes);
  /// Closes its input and waits for its end. Returns "" when it returned 0, otherwise in words how it ended,
  /// with the last line of its standard error.
  std::string finish();

 private:
  std::string last_error_line() const;

  pid_t process_ = -1;
  int input_ = -1;
  int errors_ = -1;
};

}  // namespace roomcut::synthesize
