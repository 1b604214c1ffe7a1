// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <mutex>

#include "common/cli/run_stage.h"

namespace roomcut {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kRedraw{100};
constexpr std::chrono::seconds kPatience{1};  ///< piped: shorter work needs no lines
constexpr int kBarWidth = 24;

/// "12.3 M/s"
std::string rate_text(double per_second) {
  const char* prefix = "";
  for (const char* next : {"k", "M", "G"}) {
    if (per_second < 1000) {
      break;
    }
    per_second /= 1000;
    prefix = next;
  }
  char text[40];
  std::snprintf(text, sizeof text, "%.3g %s/s", per_second, prefix);
  return text;
}

/// "48 s", "12 min", "3 h 05 min"
std::string time_text(double seconds) {
  char text[40];
  const auto minutes = static_cast<long>(std::min(seconds, 1e9) / 60);
  if (seconds < 90) {
    std::snprintf(text, sizeof text, "%.0f s", std::ceil(seconds));
  } else if (minutes < 90) {
    std::snprintf(text, sizeof text, "%ld min", minutes + 1);
  } else {
    std::snprintf(text, sizeof text, "%ld h %02ld min", minutes / 60, minutes % 60);
  }
  return text;
}

}  // namespace

struct Progress::State {
  std::string what;
  std::uint64_t total;
  bool terminal;
  bool silent;
  Clock::time_point start = Clock::now();
  std::atomic<std::uint64_t> done{0};
  std::mutex mutex;  ///< guards what follows
  Clock::time_point last = start;
  std::uint64_t last_tenth = 0;
  bool drawn = false;

  void draw(std::uint64_t now_done, Clock::time_point now) {
    const double seconds = std::chrono::duration<double>(now - start).count();
    const double share =
        total > 0 ? std::min(1.0, static_cast<double>(now_done) / static_cast<double>(total)) : 0.0;
    const double rate = static_cast<double>(now_done) / std::max(seconds, 1e-9);
    const double left = share > 0 ? seconds * (1 - share) / share : 0;
    const int percent = static_cast<int>(share * 100);
    if (terminal) {
      std::string bar(kBarWidth, ' ');
      std::fill_n(bar.begin(), static_cast<int>(share * kBarWidth), '#');
      std::fprintf(stderr, "\r%s [%s] %3d %%  %s, %s left \033[K", what.c_str(), bar.c_str(), percent,
                   rate_text(rate).c_str(), time_text(left).c_str());
      std::fflush(stderr);
      drawn = true;
    } else {
      std::fprintf(stderr, "%s: %d %%, %s, %s left\n", what.c_str(), percent, rate_text(rate).c_str(),
                   time_text(left).c_str());
    }
  }
};

Progress::Progress(std::string what, std::uint64_t total, bool quiet) : state_(std::make_unique<State>()) {
  state_->what = std::move(what);
  state_->total = total;
  state_->terminal = ::isatty(STDERR_FILENO) == 1;
  state_->silent = quiet || total == 0;
}

Progress::~Progress() {
  if (state_ && state_->drawn) {
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
  }
}

void Progress::advance(std::uint64_t amount) {
  State& s = *state_;
  const std::uint64_t done = s.done.fetch_add(amount, std::memory_order_relaxed) + amount;
  if (s.silent) {
    return;
  }
  const std::unique_lock lock(s.mutex, std::try_to_lock);
  if (!lock.owns_lock()) {
    return;
  }
  const auto now = Clock::now();
  const std::uint64_t tenth = done * 10 / s.total;
  const bool due = s.terminal ? now - s.last >= kRedraw : now - s.last >= kPatience && tenth > s.last_tenth;
  if (due && tenth < 10) {
    s.last = now;
    s.last_tenth = tenth;
    s.draw(done, now);
  }
}

}  // namespace roomcut
