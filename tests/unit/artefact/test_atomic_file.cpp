// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/artefact/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>

#include "tests/unit/artefact/temporary_folder.h"

namespace roomcut::test {

namespace {

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// Runs `child` in another process and waits; its exit status as waitpid gives it.
int in_child(const std::function<void()>& child) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    child();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  return status;
}

}  // namespace

TEST(AtomicFile, shows_the_final_name_only_after_commit) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "sub/a.txt");
  file.write("one");
  file.write("two");
  EXPECT_FALSE(std::filesystem::exists(folder / "sub/a.txt"));
  file.commit();
  EXPECT_EQ(bytes_of(folder / "sub/a.txt"), "onetwo");
  EXPECT_EQ(files_in(folder / "sub"), 1U);
}

TEST(AtomicFile, leaves_the_old_file_when_it_is_given_up) {
  const TemporaryFolder folder;
  put_bytes(folder / "a.txt", "old");
  {
    const AtomicFile file(folder / "a.txt");
    file.write("new");
  }
  EXPECT_EQ(bytes_of(folder / "a.txt"), "old");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(AtomicFile, of_a_killed_process_leaves_nothing_under_the_final_name_and_is_cleared_by_the_next_writer) {
  const TemporaryFolder folder;
  const int status = in_child([&] {
    const AtomicFile file(folder / "a.txt");
    file.write("half");
    ::raise(SIGKILL);
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  EXPECT_EQ(files_in(folder.path()), 1U) << "the killed process should have left its temporary file";
  AtomicFile(folder / "a.txt").commit();
  EXPECT_EQ(files_in(folder.path()), 1U);
  EXPECT_TRUE(std::filesystem::exists(folder / "a.txt"));
}

TEST(AtomicFile, of_a_killed_process_that_nobody_collected_is_cleared_too) {
  const TemporaryFolder folder;
  const pid_t pid = ::fork();
  if (pid == 0) {
    const AtomicFile file(folder / "a.txt");
    ::raise(SIGKILL);
  }
  siginfo_t info{};
  ::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOWAIT);
  ASSERT_EQ(files_in(folder.path()), 1U);
  AtomicFile(folder / "a.txt").commit();
  EXPECT_EQ(files_in(folder.path()), 1U);
  ::waitpid(pid, nullptr, 0);
}

TEST(AtomicFile, of_a_living_process_is_left_alone_by_others) {
  const TemporaryFolder folder;
  AtomicFile mine(folder / "a.txt");
  mine.write("mine");
  in_child([&] { AtomicFile(folder / "a.txt").commit(); });
  mine.commit();
  EXPECT_EQ(bytes_of(folder / "a.txt"), "mine");
}

TEST(AtomicFile, keeps_the_time_of_the_replaced_file_when_asked) {
  const TemporaryFolder folder;
  for (const bool keep : {true, false}) {
    put_bytes(folder / "a.txt", "old");
    make_old(folder / "a.txt");
    AtomicFile file(folder / "a.txt");
    file.write("new");
    file.commit(keep);
    EXPECT_EQ(is_old(folder / "a.txt"), keep);
    EXPECT_EQ(bytes_of(folder / "a.txt"), "new");
  }
}

TEST(AtomicFile, is_refused_where_nothing_can_be_written) {
  const TemporaryFolder folder;
  put_bytes(folder / "file", "");
  EXPECT_EQ(code_of([&] { AtomicFile(folder / "file/a.txt"); }), "O01");
  std::filesystem::create_directory(folder / "folder");
  EXPECT_EQ(code_of([&] { AtomicFile(folder / "folder").commit(); }), "O01");
}

TEST(AtomicFile, never_takes_the_place_of_a_device_a_pipe_or_a_folder) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_directory(folder / "folder");
  for (const auto& path : {folder / "pipe", folder / "folder", std::filesystem::path("/dev/null")}) {
    EXPECT_EQ(code_of([&] { const AtomicFile file(path); }), "O01") << path;
  }
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  EXPECT_EQ(files_in(folder.path()), 2U);
}

TEST(AtomicFile, that_cannot_be_put_in_place_says_so_with_a_remedy_whatever_the_reason) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "a.txt");
  std::filesystem::create_directories(folder / "a.txt/in the way");
  try {
    file.commit();
    FAIL() << "a folder was replaced";
  } catch (const StageError& error) {
    EXPECT_EQ(error.problems().front().code.id, std::string("O01"));
    EXPECT_NE(error.problems().front().hint, "");
  }
}

TEST(AtomicFile, is_removed_when_the_disk_is_full) {
  const TemporaryFolder folder;
  const int status = in_child([&] {
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::signal(SIGXFSZ, SIG_IGN);
    std::string text;
    const std::string code =
        code_of([&] { write_text_file(folder / "a.txt", std::string(5000, 'x')); }, &text);
    ::_exit(code == "O01" && text.find("hint:") != std::string::npos ? 7 : 8);
  });
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(files_in(folder.path()), 0U);
}

TEST(WriteTextFile, leaves_a_file_with_the_same_bytes_as_it_is) {
  const TemporaryFolder folder;
  EXPECT_TRUE(write_text_file(folder / "a.txt", "text"));
  make_old(folder / "a.txt");
  EXPECT_FALSE(write_text_file(folder / "a.txt", "text"));
  EXPECT_TRUE(is_old(folder / "a.txt"));
  EXPECT_TRUE(write_text_file(folder / "a.txt", "texT"));
  EXPECT_FALSE(is_old(folder / "a.txt"));
  EXPECT_EQ(read_text_file(folder / "a.txt"), "texT");
}

TEST(RemoveTemporaryFiles, removes_those_of_this_process_only) {
  const TemporaryFolder folder;
  put_bytes(folder / ".b.1.tmp", "of another process");
  const AtomicFile file(folder / "a.txt");
  EXPECT_EQ(files_in(folder.path()), 2U);
  remove_temporary_files();
  EXPECT_EQ(files_in(folder.path()), 1U);
}

}  // namespace roomcut::test
