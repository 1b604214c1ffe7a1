// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/decoder_process.h"

#include <gtest/gtest.h>

#include <array>

namespace roomcut::testing {
using namespace roomcut::ingest;

namespace {

DecoderProcess shell(const std::string& words) {
  return DecoderProcess({"/bin/sh", "-c", words});
}

TEST(DecoderProcess, gives_what_is_printed_and_ends_well) {
  DecoderProcess process = shell("printf abcdef");
  std::array<std::byte, 4> bytes{};
  EXPECT_EQ(process.read(bytes), 4U);
  EXPECT_EQ(process.read(bytes), 2U);
  EXPECT_EQ(bytes[1], std::byte{'f'});
  EXPECT_EQ(process.finish(), "");
}

TEST(DecoderProcess, says_how_it_ended_and_its_last_words) {
  DecoderProcess process = shell("echo first >&2; echo no luck >&2; exit 3");
  EXPECT_EQ(process.finish(), "ended with 3: no luck");
  DecoderProcess killed = shell("kill -9 $$");
  EXPECT_EQ(killed.finish(), "was ended by signal 9");
}

TEST(DecoderProcess, that_is_stopped_ends_and_is_not_waited_for) {
  DecoderProcess process = shell("printf ab; kill -STOP $$; printf cd");
  std::array<std::byte, 4> bytes{};
  EXPECT_EQ(process.read(bytes), 2U);
  EXPECT_EQ(process.finish(), "was stopped by somebody (SIGSTOP)");
}

TEST(DecoderProcess, comes_to_its_end_when_it_is_told_to) {
  DecoderProcess process = shell("exec sleep 1000");
  process.stop();
  std::array<std::byte, 1> bytes{};
  EXPECT_EQ(process.read(bytes), 0U);
  EXPECT_EQ(process.finish(), "was ended by signal 9");
}

}  // namespace
}  // namespace roomcut::testing
