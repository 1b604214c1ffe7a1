// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/child_process/child_process.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string_view>

namespace roomcut::testing {

namespace {

using Stream = ChildProcess::Stream;

ChildProcess shell(const std::string& words, Stream stream = Stream::kOutput) {
  return ChildProcess({"/bin/sh", "-c", words}, stream);
}

bool write(ChildProcess& process, std::string_view text) {
  return process.write(std::as_bytes(std::span(text)));
}

TEST(ChildProcess, gives_what_is_printed_and_ends_well) {
  ChildProcess process = shell("printf abcdef");
  std::array<std::byte, 4> bytes{};
  EXPECT_EQ(process.read(bytes), 4U);
  EXPECT_EQ(process.read(bytes), 2U);
  EXPECT_EQ(bytes[1], std::byte{'f'});
  EXPECT_EQ(process.finish(), "");
}

TEST(ChildProcess, has_nothing_to_read_when_its_output_is_read) {
  ChildProcess process = shell("read line && echo got $line || printf none");
  std::array<std::byte, 8> bytes{};
  EXPECT_EQ(process.read(bytes), 4U);
  EXPECT_EQ(process.finish(), "");
}

TEST(ChildProcess, says_how_it_ended_and_its_last_words) {
  for (const Stream stream : {Stream::kOutput, Stream::kInput}) {
    ChildProcess process = shell("echo first >&2; echo no luck >&2; exit 3", stream);
    EXPECT_EQ(process.finish(), "ended with 3: no luck");
    ChildProcess killed = shell("kill -9 $$", stream);
    EXPECT_EQ(killed.finish(), "was ended by signal 9");
  }
}

TEST(ChildProcess, that_is_no_program_ends_with_127) {
  ChildProcess process({"/no/such/program"}, Stream::kOutput);
  EXPECT_EQ(process.finish(), "ended with 127");
}

TEST(ChildProcess, that_is_stopped_ends_and_is_not_waited_for) {
  ChildProcess process = shell("printf ab; kill -STOP $$; printf cd");
  std::array<std::byte, 4> bytes{};
  EXPECT_EQ(process.read(bytes), 2U);
  EXPECT_EQ(process.finish(), "was stopped by somebody (SIGSTOP)");
}

TEST(ChildProcess, comes_to_its_end_when_it_is_told_to) {
  ChildProcess process = shell("exec sleep 1000");
  process.stop();
  std::array<std::byte, 1> bytes{};
  EXPECT_EQ(process.read(bytes), 0U);
  EXPECT_EQ(process.finish(), "was ended by signal 9");
}

// Far more than a socket holds, so that it is taken in pieces.
TEST(ChildProcess, takes_all_that_is_written_to_it) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "roomcut_child_process_test";
  const std::string text(5'000'000, 'x');
  ChildProcess process({"/bin/sh", "-c", "exec cat > \"$0\"", file.string()}, Stream::kInput);
  EXPECT_TRUE(write(process, text));
  EXPECT_TRUE(write(process, "end"));
  EXPECT_EQ(process.finish(), "");
  EXPECT_EQ(std::filesystem::file_size(file), text.size() + 3);
  std::filesystem::remove(file);
}

TEST(ChildProcess, takes_nothing_when_it_has_ended) {
  ChildProcess process = shell("echo enough; exit 2", Stream::kInput);
  bool taken = true;
  for (int i = 0; taken && i < 100; ++i) {
    taken = write(process, std::string(1'000'000, 'x'));
  }
  EXPECT_FALSE(taken);
  EXPECT_EQ(process.finish(), "ended with 2: enough");
}

TEST(ChildProcess, that_is_stopped_is_not_written_to_for_ever) {
  ChildProcess process = shell("kill -STOP $$", Stream::kInput);
  EXPECT_FALSE(write(process, std::string(5'000'000, 'x')));
  EXPECT_EQ(process.finish(), "was stopped by somebody (SIGSTOP)");
}

}  // namespace
}  // namespace roomcut::testing
