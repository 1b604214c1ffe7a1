// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/pipeline_run.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace roomcut::view {

namespace {

/// Starts `command` with `out` as its standard output and error, with no other open file of ours, no
/// blocked signal and a process group of its own. Returns 0 or an errno.
int spawn(const std::vector<std::string>& command, int out, pid_t& child) {
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, out, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, out, STDERR_FILENO);
  ::posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigset_t none, usual;
  ::sigemptyset(&none);
  ::sigfillset(&usual);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &usual);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  std::vector<char*> words;
  for (const std::string& word : command) {
    words.push_back(const_cast<char*>(word.c_str()));  // posix_spawn does not write to them
  }
  words.push_back(nullptr);
  const int result = ::posix_spawnp(&child, words[0], &files, &attributes, words.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  return result;
}

}  // namespace

bool PipelineRun::start() {
  const std::scoped_lock lock(mutex_);
  if (progress_.running) {
    return false;
  }
  if (follower_.joinable()) {
    follower_.join();  // of the last run: it has ended
  }
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  const int failed = spawn(command_, ends[1], child_);
  ::close(ends[1]);
  if (failed != 0) {
    ::close(ends[0]);
    child_ = -1;
    throw std::system_error(failed, std::generic_category(), command_[0]);
  }
  progress_.start();
  follower_ = std::thread(&PipelineRun::follow, this, ends[0], child_);
  return true;
}

void PipelineRun::follow(int pipe, pid_t child) {
  std::array<char, 4096> buffer{};
  std::string line;
  for (;;) {
    const ssize_t count = ::read(pipe, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) {
      continue;
    }
    if (count <= 0) {
      break;
    }
    for (ssize_t i = 0; i < count; ++i) {
      if (buffer[i] != '\n') {
        line += buffer[i];
        continue;
      }
      const std::scoped_lock lock(mutex_);
      progress_.add_line(line);
      line.clear();
    }
  }
  ::close(pipe);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const std::scoped_lock lock(mutex_);
  if (!line.empty()) {
    progress_.add_line(line);
  }
  child_ = -1;
  progress_.finish(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
}

RunProgress PipelineRun::progress() const {
  const std::scoped_lock lock(mutex_);
  return progress_;
}

void PipelineRun::stop() {
  {
    const std::scoped_lock lock(mutex_);
    if (child_ > 0) {
      ::kill(-child_, SIGTERM);
    }
  }
  if (follower_.joinable()) {
    follower_.join();
  }
}

}  // namespace roomcut::view
