// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/slice/vault_warning.h"

#include <gtest/gtest.h>

namespace roomcut::slice {
namespace {

Slices with_planes(int count, double area_m2, double rms_m) {
  Slices slices;
  slices.noise_m = 0.005;
  for (int i = 0; i < count; ++i) {
    SlopedPlane plane;
    plane.area_m2 = area_m2;
    plane.rms_m = rms_m;
    slices.planes.push_back(plane);
  }
  return slices;
}

TEST(VaultWarning, SaysHowMuchOfADomeIsFacetsAndHowFarTheyAreOff) {
  const std::string warning = vault_warning(with_planes(12, 2.5, 0.031));
  EXPECT_NE(warning.find("30 m^2"), std::string::npos) << warning;
  EXPECT_NE(warning.find("12 facets"), std::string::npos) << warning;
  EXPECT_NE(warning.find("3.1 cm"), std::string::npos) << warning;
}

TEST(VaultWarning, RoofsAndDetailsNeedNone) {
  EXPECT_EQ(vault_warning(with_planes(4, 60, 0.006)), "");
  EXPECT_EQ(vault_warning(with_planes(3, 2.5, 0.031)), "") << "less than 10 m^2";
  Slices noisy = with_planes(12, 2.5, 0.031);
  noisy.noise_m = 0.02;
  EXPECT_EQ(vault_warning(noisy), "") << "within the noise";
}

}  // namespace
}  // namespace roomcut::slice
