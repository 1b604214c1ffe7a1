// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/weigh_faces/sparse_counts.h"

#include <gtest/gtest.h>

#include <map>

namespace roomcut::weigh_faces {
namespace {

TEST(SparseCounts, VisitsWhatIsNotZeroInARange) {
  SparseCounts counts(5000);
  for (const std::size_t i : {7UL, 1023UL, 1023UL, 1024UL, 3000UL, 4999UL, 4999UL, 4999UL}) {
    counts.add(i);
  }
  using Found = std::map<std::size_t, std::uint32_t>;
  const auto found = [&](std::size_t begin, std::size_t end) {
    Found result;
    std::size_t last = 0;
    counts.for_each(begin, end, [&](std::size_t i, std::uint32_t count) {
      EXPECT_TRUE(result.empty() || i > last);
      last = i;
      result[i] = count;
      EXPECT_EQ(count, counts.at(i));
    });
    return result;
  };
  EXPECT_EQ(found(0, 5000), (Found{{7, 1}, {1023, 2}, {1024, 1}, {3000, 1}, {4999, 3}}));
  EXPECT_EQ(found(8, 1024), (Found{{1023, 2}})) << "ends in the middle of nothing, begins within a block";
  EXPECT_EQ(found(1024, 3000), (Found{{1024, 1}}));
  EXPECT_TRUE(found(2048, 2048).empty());
}

}  // namespace
}  // namespace roomcut::weigh_faces
