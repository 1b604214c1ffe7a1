// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/encoder_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

namespace roomcut::synthesize {

namespace {

constexpr std::size_t kErrorTail = 1 << 12;

/// In the new process: only what may be called between fork and exec.
[[noreturn]] void become(char* const* arguments, int input, int errors) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXFSZ}) {
    ::signal(number, SIG_DFL);
  }
  ::dup2(input, STDIN_FILENO);
  ::dup2(errors, STDOUT_FILENO);
  ::dup2(errors, STDERR_FILENO);
  ::execv(arguments[0], arguments);
  ::_exit(127);
}

}  // namespace

EncoderProcess::EncoderProcess(const std::vector<std::string>& command) {
  // A socket instead of a pipe: writing to one whose other end is gone can be told not to raise SIGPIPE.
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::system_error(errno, std::generic_category(), "socketpair");
  }
  input_ = ends[0];
  errors_ = ::memfd_create("encoder", MFD_CLOEXEC);
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  process_ = ::fork();
  if (process_ == 0) become(arguments.data(), ends[1], errors_);
  const int failure = errno;
  ::close(ends[1]);
  if (process_ < 0) {
    ::close(input_);
    ::close(errors_);
    throw std::system_error(failure, std::generic_category(), "fork");
  }
}

EncoderProcess::~EncoderProcess() {
  if (input_ >= 0) ::close(input_);
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  ::close(errors_);
}

bool EncoderProcess::write(const void* data, std::size_t bytes) {
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t sent = ::send(input_, from, bytes, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    from += sent;
    bytes -= static_cast<std::size_t>(sent);
  }
  return true;
}

std::string EncoderProcess::last_error_line() const {
  std::array<char, kErrorTail> bytes{};
  const off_t size = ::lseek(errors_, 0, SEEK_END);
  const off_t from = std::max<off_t>(0, size - static_cast<off_t>(kErrorTail));
  const ssize_t got = ::pread(errors_, bytes.data(), bytes.size(), from);
  std::string text(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  text.erase(text.find_last_not_of(" \r\n") + 1);
  return text.substr(text.find_last_of('\n') + 1);  // npos + 1 = 0
}

std::string EncoderProcess::finish() {
  ::close(input_);
  input_ = -1;
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  const std::string how = WIFSIGNALED(status) ? "was ended by signal " + std::to_string(WTERMSIG(status))
                                              : "ended with " + std::to_string(WEXITSTATUS(status));
  const std::string said = last_error_line();
  return said.empty() ? how : how + ": " + said.substr(0, 200);
}

}  // namespace roomcut::synthesize
