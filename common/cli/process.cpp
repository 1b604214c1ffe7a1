// SPDX-License-Identifier: GPL-3.0-or-later
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "common/artefact/atomic_file.h"
#include "common/cli/stage_state.h"

namespace roomcut {

namespace {

void end_by_signal(int number) {
  remove_temporary_files();
  ::signal(number, SIG_DFL);
  ::raise(number);
}

void end_by_bug(int /*number*/) {
  remove_temporary_files();
  static constexpr std::string_view kText =
      "error: a check inside the program failed, or it crashed; this is a bug, please report it\n";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, kText.data(), kText.size());
  ::_exit(static_cast<int>(ExitCode::kBug));
}

/// On a stack of its own, since an overflown stack is one of the causes.
void catch_crashes() {
  static std::array<char, 65536> memory;
  stack_t stack{};
  stack.ss_sp = memory.data();
  stack.ss_size = memory.size();
  ::sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_handler = end_by_bug;
  action.sa_flags = SA_ONSTACK;
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) {
    ::sigaction(number, &action, nullptr);
  }
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

}  // namespace

void install_signal_handlers() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    ::signal(number, end_by_signal);
  }
  ::signal(SIGABRT, end_by_bug);
  if (!kSanitized) {  // the sanitizer has more to say about these
    catch_crashes();
  }
  ::signal(SIGXFSZ, SIG_IGN);
}

int available_threads() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? std::max(1, CPU_COUNT(&set)) : 1;
}

Usage usage_since(std::chrono::steady_clock::time_point start) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return {wall.count(), seconds(used.ru_utime) + seconds(used.ru_stime),
          static_cast<double>(used.ru_maxrss) / 1024.0};
}

}  // namespace roomcut
