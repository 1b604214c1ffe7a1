// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/child_process/child_process.h"

#include <fcntl.h>
#include <poll.h>
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

extern "C" {  // glibc 2.36 declares them for C alone
#include <sys/pidfd.h>
}

namespace roomcut {

namespace {

constexpr int kPipeBytes = 1 << 20;
constexpr std::size_t kErrorTail = 1 << 12;
constexpr std::size_t kLongestLine = 200;
constexpr int kLook_ms = 500;  // between two looks whether it was stopped; nothing else depends on it

[[noreturn]] void failed(const char* what, int number = errno) {
  throw std::system_error(number, std::generic_category(), what);
}

/// Both ends of the stream, ours first.
std::array<int, 2> joined_ends(ChildProcess::Stream stream) {
  std::array<int, 2> ends{-1, -1};
  // A socket to write to: one whose other end is gone can be told not to raise SIGPIPE.
  if (stream == ChildProcess::Stream::kInput) {
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
      failed("socketpair");
    }
  } else {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
      failed("pipe");
    }
    ::fcntl(ends[0], F_SETPIPE_SZ, kPipeBytes);  // fewer switches between the two; without it all goes slower
  }
  return ends;
}

/// In the new process: only what may be called between fork and exec.
[[noreturn]] void become(char* const* arguments, pid_t parent, int input, int output, int errors) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) {
    ::_exit(127);  // it ended before it could be watched
  }
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXFSZ}) {
    ::signal(number, SIG_DFL);
  }
  ::dup2(input, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(errors, STDERR_FILENO);
  ::execv(arguments[0], arguments);
  ::_exit(127);
}

}  // namespace

// Delegating, so that the destructor takes back what was opened when something fails.
ChildProcess::ChildProcess(std::vector<std::string> command, Stream stream) : ChildProcess() {
  is_input_ = stream == Stream::kInput;
  errors_ = ::memfd_create("standard error", MFD_CLOEXEC);
  if (errors_ < 0) {
    failed("memfd_create");
  }
  const std::array<int, 2> ends = joined_ends(stream);
  stream_ = ends[0];
  std::vector<char*> arguments;
  for (std::string& word : command) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) {
    const int input = is_input_ ? ends[1] : ::open("/dev/null", O_RDONLY);
    become(arguments.data(), parent, input, is_input_ ? errors_ : ends[1], errors_);
  }
  const int number = errno;
  ::close(ends[1]);
  if (process_ < 0) {
    failed("fork", number);
  }
  handle_ = ::pidfd_open(process_, 0);
  if (handle_ < 0) {
    const int reason = errno;
    ::kill(process_, SIGKILL);
    failed("pidfd_open", reason);
  }
}

ChildProcess::~ChildProcess() {
  ::close(stream_);
  if (process_ > 0) {
    stop();
    reap();
  }
  ::close(handle_);
  ::close(errors_);
}

void ChildProcess::stop() const {
  ::pidfd_send_signal(handle_, SIGKILL, nullptr, 0);
}

bool ChildProcess::wait_for(int descriptor, short events) const {
  pollfd waiting{descriptor, events, 0};
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

std::size_t ChildProcess::read(std::span<std::byte> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    if (!wait_for(stream_, POLLIN)) {
      stands_still_ = true;
      break;
    }
    const ssize_t got = ::read(stream_, bytes.data() + done, bytes.size() - done);
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

bool ChildProcess::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    if (!wait_for(stream_, POLLOUT)) {
      stands_still_ = true;
      return false;
    }
    const ssize_t sent = ::send(stream_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EINTR || errno == EAGAIN)) {
      continue;
    }
    if (sent <= 0) {
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return true;
}

int ChildProcess::reap() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

std::string ChildProcess::last_error_line() const {
  std::array<char, kErrorTail> bytes{};
  const off_t size = ::lseek(errors_, 0, SEEK_END);
  const off_t from = std::max<off_t>(0, size - static_cast<off_t>(kErrorTail));
  const ssize_t got = ::pread(errors_, bytes.data(), bytes.size(), from);
  std::string text(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  text.erase(text.find_last_not_of(" \r\n") + 1);
  return text.substr(text.find_last_of('\n') + 1);  // npos + 1 = 0
}

std::string ChildProcess::finish() {
  if (is_input_) {
    ::close(stream_);
    stream_ = -1;
  }
  stands_still_ = stands_still_ || !wait_for(handle_, POLLIN);
  if (stands_still_) {
    stop();
  }
  const int status = reap();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    return "";
  }
  if (stands_still_) {
    return "was stopped by somebody (SIGSTOP)";
  }
  const std::string how = WIFSIGNALED(status) ? "was ended by signal " + std::to_string(WTERMSIG(status))
                                              : "ended with " + std::to_string(WEXITSTATUS(status));
  const std::string said = last_error_line();
  return said.empty() ? how : how + ": " + said.substr(0, kLongestLine);
}

}  // namespace roomcut
