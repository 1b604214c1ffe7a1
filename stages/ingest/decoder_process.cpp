// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/decoder_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

extern "C" {  // glibc 2.36 declares them for C alone
#include <sys/pidfd.h>
}

namespace roomcut::ingest {

namespace {

constexpr int kPipeBytes = 1 << 20;
constexpr std::size_t kErrorTail = 1 << 12;
constexpr int kLook_ms = 500;  // between two looks whether it was stopped; nothing else depends on it

[[noreturn]] void failed(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// In the new process: only what may be called between fork and exec.
[[noreturn]] void become(char* const* arguments, pid_t parent, int output, int errors) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) {
    ::_exit(127);  // it ended before it could be watched
  }
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXFSZ}) {
    ::signal(number, SIG_DFL);
  }
  const int none = ::open("/dev/null", O_RDONLY);
  ::dup2(none, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(errors, STDERR_FILENO);
  ::execv(arguments[0], arguments);
  ::_exit(127);
}

}  // namespace

DecoderProcess::DecoderProcess(const std::vector<std::string>& command) {
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    failed("pipe");
  }
  output_ = ends[0];
  errors_ = ::memfd_create("decoder", MFD_CLOEXEC);
  ::fcntl(output_, F_SETPIPE_SZ, kPipeBytes);  // fewer switches between the two; without it all goes slower
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) {
    become(arguments.data(), parent, ends[1], errors_);
  }
  ::close(ends[1]);
  if (process_ < 0) {
    failed("fork");
  }
  handle_ = ::pidfd_open(process_, 0);
  if (handle_ < 0) {
    ::kill(process_, SIGKILL);
    failed("pidfd_open");
  }
}

DecoderProcess::~DecoderProcess() {
  ::close(output_);
  if (process_ > 0) {
    stop();
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  ::close(handle_);
  ::close(errors_);
}

void DecoderProcess::stop() const {
  ::pidfd_send_signal(handle_, SIGKILL, nullptr, 0);
}

bool DecoderProcess::wait_for(int descriptor) const {
  pollfd waiting{descriptor, POLLIN, 0};
  int looks = 0;  // Ctrl-Z stops both, and the one may go on a moment before the other
  while (looks < 2) {
    const int ready = ::poll(&waiting, 1, kLook_ms);
    if (ready > 0) {
      return true;
    }
    siginfo_t state{};
    const bool stopped =
        ready == 0 &&
        ::waitid(P_PID, static_cast<id_t>(process_), &state, WSTOPPED | WNOHANG | WNOWAIT) == 0 &&
        state.si_pid == process_;
    looks = stopped ? looks + 1 : 0;
  }
  return false;
}

std::size_t DecoderProcess::read(std::span<std::byte> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    if (!wait_for(output_)) {
      stands_still_ = true;
      break;
    }
    const ssize_t got = ::read(output_, bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got <= 0) {
      break;
    }
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::string DecoderProcess::last_error_line() const {
  std::array<char, kErrorTail> bytes{};
  const off_t size = ::lseek(errors_, 0, SEEK_END);
  const off_t from = std::max<off_t>(0, size - static_cast<off_t>(kErrorTail));
  const ssize_t got = ::pread(errors_, bytes.data(), bytes.size(), from);
  std::string text(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  text.erase(text.find_last_not_of(" \r\n") + 1);
  const std::size_t begin = text.find_last_of('\n');
  return begin == std::string::npos ? text : text.substr(begin + 1);
}

std::string DecoderProcess::finish() {
  int status = 0;
  stands_still_ = stands_still_ || !wait_for(handle_);
  if (stands_still_) {
    stop();
  }
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    return "";
  }
  if (stands_still_) {
    return "was stopped by somebody (SIGSTOP)";
  }
  const std::string how = WIFSIGNALED(status) ? "was ended by signal " + std::to_string(WTERMSIG(status))
                                              : "ended with " + std::to_string(WEXITSTATUS(status));
  const std::string said = last_error_line();
  return said.empty() ? how : how + ": " + said.substr(0, 200);
}

}  // namespace roomcut::ingest
