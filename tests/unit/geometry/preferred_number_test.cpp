// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/geometry/preferred_number.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace roomcut {
namespace {

TEST(PreferredNumber, IsOneOfTwentyPerDecadeAndNear) {
  EXPECT_NEAR(preferred_number(0.1), 0.1, 1e-15);
  EXPECT_NEAR(preferred_number(0.113), 0.1122, 1e-4);
  EXPECT_NEAR(preferred_number(1.0), 1.0, 1e-15);
  for (const double value : {0.003, 0.047, 0.21, 1.7, 33.0, 480.0}) {
    EXPECT_NEAR(preferred_number(value) / value, 1, 0.06) << value;
    EXPECT_EQ(preferred_number(value), preferred_number(preferred_number(value))) << value;
  }
}

TEST(PreferredNumber, StaysWhenWhatWasMeasuredChangesALittle) {
  EXPECT_EQ(preferred_number(0.04517), preferred_number(0.04519));
  EXPECT_EQ(preferred_number_above(14.03), preferred_number_above(14.06));
}

TEST(PreferredNumber, AboveIsNeverLess) {
  for (const double value : {0.02, 1.0, 9.99, 14.0, 250.0}) {
    EXPECT_GE(preferred_number_above(value), value * (1 - 1e-9)) << value;
    EXPECT_LT(preferred_number_above(value), 1.13 * value) << value;
  }
}

}  // namespace
}  // namespace roomcut
