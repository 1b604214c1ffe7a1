// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/byte_range.h"

#include <gtest/gtest.h>

#include <string>

namespace roomcut::view {
namespace {

TEST(ByteRange, NeverReachesBeyondTheFile) {
  for (const std::uint64_t size : {0U, 1U, 7U, 1000U}) {
    for (const char* from :
         {"", "0", "1", "6", "7", "999", "1000", "18446744073709551615", "99999999999999999999"}) {
      for (const char* to : {"", "0", "5", "7", "1000", "18446744073709551615", "99999999999999999999"}) {
        const auto part = byte_range("bytes=" + std::string(from) + "-" + to, size);
        if (part) {
          EXPECT_LE(part->offset, size) << from << "-" << to;
          EXPECT_LE(part->length, size - part->offset) << from << "-" << to;
          EXPECT_TRUE(part->whole || part->length > 0) << from << "-" << to;
        }
      }
    }
  }
}

TEST(ByteRange, IsWhatWasAskedForWhereTheFileHasIt) {
  const auto part = byte_range("bytes=5-9", 100);
  ASSERT_TRUE(part);
  EXPECT_FALSE(part->whole);
  EXPECT_EQ(part->offset, 5U);
  EXPECT_EQ(part->length, 5U);
  EXPECT_EQ(byte_range("bytes=90-", 100)->length, 10U);
  EXPECT_EQ(byte_range("bytes=-30", 100)->offset, 70U);
  EXPECT_FALSE(byte_range("bytes=100-", 100));
  EXPECT_FALSE(byte_range("bytes=-0", 100));
}

TEST(ByteRange, WhatIsNotUnderstoodGetsTheWholeFile) {
  for (const char* header : {"", "bytes", "bytes=", "bytes=-", "bytes=a-b", "bytes=5-1", "bytes=0-1,4-5",
                             "bytes=1--2", "pages=0-1", "bytes=+1-2"}) {
    const auto part = byte_range(header, 100);
    ASSERT_TRUE(part) << header;
    EXPECT_TRUE(part->whole) << header;
    EXPECT_EQ(part->length, 100U) << header;
  }
}

}  // namespace
}  // namespace roomcut::view
