// SPDX-License-Identifier: GPL-3.0-or-later
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
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

void end_by_assertion(int /*number*/) {
  remove_temporary_files();
  static constexpr std::string_view kText =
      "error: a check inside the program failed; this is a bug, please report it\n";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, kText.data(), kText.size());
  ::_exit(static_cast<int>(ExitCode::kBug));
}

}  // namespace

void install_signal_handlers() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    ::signal(number, end_by_signal);
  }
  ::signal(SIGABRT, end_by_assertion);
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
