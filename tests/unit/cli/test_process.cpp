// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cassert>
#include <csignal>
#include <filesystem>
#include <new>
#include <system_error>
#include <thread>

#include "common/cli/run_stage.h"
#include "tests/unit/cli/sample_stage.h"

namespace roomcut::test {

namespace {

/// Runs the sample stage in a child with a body that begins an output and then does `then`.
int status_of(const TemporaryFolder& folder, const std::function<void()>& then) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    const Outcome o = run_sample({"--work", folder.path(), "-q"}, [&](StageRun& run, double) {
      H5Writer writer(run.output("slices"), artefacts::kSlices, {}, {});
      then();
      writer.write<double>("v", std::vector<double>(100000, 1.0), "m", "values");
      writer.commit();
    });
    ::_exit(o.exit_code);
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  return status;
}

}  // namespace

TEST(Process, ended_by_a_polite_signal_leaves_no_file_and_dies_of_it) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    const int status = status_of(folder, [number] { ::raise(number); });
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), number);
    EXPECT_TRUE(std::filesystem::is_empty(folder / "20_slice"));
  }
}

TEST(Process, whose_assertion_fails_has_a_bug_and_leaves_no_file) {
  const TemporaryFolder folder;
  const int status = status_of(folder, [] { std::abort(); });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "20_slice"));
}

TEST(Process, that_crashes_has_a_bug_and_leaves_no_file) {
  for (const int number : {SIGSEGV, SIGFPE}) {
    const TemporaryFolder folder;
    const int status = status_of(folder, [number] { ::raise(number); });
#ifndef ROOMCUT_SANITIZED
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_TRUE(std::filesystem::is_empty(folder / "20_slice"));
#else
    EXPECT_NE(status, 0);
#endif
  }
}

#ifndef ROOMCUT_SANITIZED
TEST(Process, that_runs_out_of_memory_where_nobody_catches_it_ends_with_4_and_leaves_no_file) {
  const TemporaryFolder folder;
  const int status = status_of(folder, [] { std::thread([] { throw std::bad_alloc(); }).join(); });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "20_slice"));
}
#endif

TEST(Process, that_is_refused_memory_by_the_system_ends_with_4) {
  const TemporaryFolder folder;
  const int status = status_of(folder, [] {
    throw std::filesystem::filesystem_error("path", std::make_error_code(std::errc::not_enough_memory));
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4);
}

TEST(Process, that_fills_the_disk_ends_with_5_and_leaves_no_file) {
  const TemporaryFolder folder;
  const int status = status_of(folder, [] {
    const rlimit limit{50000, 50000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 5);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "20_slice"));
}

}  // namespace roomcut::test
