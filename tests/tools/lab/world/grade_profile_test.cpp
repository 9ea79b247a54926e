// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/world/grade_profile.hpp"

#include <gtest/gtest.h>

#include <array>

namespace terracut::world {
namespace {

constexpr std::array<GradeProfile::Knot, 3> kKnots = {{{-10, 0.0}, {30, 0.15}, {100, 0.15}}};

TEST(GradeProfile, IsLevelWithoutKnots) {
  EXPECT_EQ(GradeProfile().height_m(123), 0);
  EXPECT_EQ(GradeProfile().grade(123), 0);
}

TEST(GradeProfile, StartsAtHeightZero) {
  EXPECT_NEAR(GradeProfile(kKnots).height_m(0), 0, 1e-12);
}

TEST(GradeProfile, HeightIsTheSumOfItsGrades) {
  const GradeProfile profile(kKnots);
  double height_m = profile.height_m(-50);
  constexpr double kStep_m = 0.01;
  for (int i = 0; i < 20000; ++i) {
    const double s_m = -50 + i * kStep_m;
    ASSERT_NEAR(profile.height_m(s_m), height_m, 1e-6) << "at " << s_m;
    height_m += kStep_m * profile.grade(s_m + kStep_m / 2);
  }
}

TEST(GradeProfile, KeepsTheLastGradeBeyondTheEnds) {
  const GradeProfile profile(kKnots);
  EXPECT_NEAR(profile.height_m(-60), profile.height_m(-10), 1e-12);
  EXPECT_NEAR(profile.height_m(300) - profile.height_m(200), 15, 1e-9);
  EXPECT_NEAR(profile.steepest(), 0.15, 1e-12);
}

}  // namespace
}  // namespace terracut::world
