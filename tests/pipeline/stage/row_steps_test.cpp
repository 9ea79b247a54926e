// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stage/row_steps.hpp"

#include <gtest/gtest.h>

#include <initializer_list>

#include "calib/beams/angle.hpp"

namespace terracut::stage {
namespace {

mount::RingProfile rows_at(std::initializer_list<double> elevations_deg) {
  mount::RingProfile profile;
  for (const double deg : elevations_deg) {
    profile.rings.push_back({beams::deg_to_rad(deg), 0, 0});
  }
  return profile;
}

TEST(RowSteps, GoFromRowToRowWhereRowsLieFarApart) {
  const auto profile = rows_at({-10, -9.6, -9.1, -8.8});
  const RowSteps steps(profile, 0.25);
  EXPECT_EQ(steps.up(0, 1), 1);
  EXPECT_EQ(steps.up(0, 2), 2);
  EXPECT_EQ(steps.up(1, 2), 3);
  EXPECT_EQ(steps.down(3, 1), 2);
  EXPECT_EQ(steps.down(3, 3), 0);
}

TEST(RowSteps, GoOverRowsThatLieCloserThanAStep) {
  const auto profile = rows_at({-0.5, -0.4, -0.3, -0.2, -0.1, 0, 0.1});
  const RowSteps steps(profile, 0.2);
  EXPECT_EQ(steps.up(0, 1), 2);
  EXPECT_EQ(steps.up(0, 2), 4);
  EXPECT_EQ(steps.down(6, 1), 4);
  EXPECT_EQ(steps.down(6, 3), 0);
}

TEST(RowSteps, GoToTheNextRowHoweverFar) {
  const auto profile = rows_at({-25, -19.58, -16.04, -15.9});
  const RowSteps steps(profile, 0.25);
  EXPECT_EQ(steps.up(0, 1), 1);
  EXPECT_EQ(steps.up(0, 2), 2);
  EXPECT_EQ(steps.up(2, 1), 4);  // nothing far enough up
}

TEST(RowSteps, EndAtTheLastRows) {
  const auto profile = rows_at({-2, -1, 0});
  const RowSteps steps(profile, 0.25);
  EXPECT_EQ(steps.up(1, 1), 2);
  EXPECT_EQ(steps.up(1, 2), 3);
  EXPECT_EQ(steps.down(1, 1), 0);
  EXPECT_EQ(steps.down(1, 2), -1);
}

TEST(RowSteps, OfNoSizeAreRows) {
  const auto profile = rows_at({0, 0, 0.001, 0.002});
  const RowSteps steps(profile, 0);
  for (int row = 0; row < 3; ++row) EXPECT_EQ(steps.up(row, 1), row + 1);
  EXPECT_EQ(steps.up(2, 0), 2);
  EXPECT_EQ(steps.down(3, 2), 1);
}

}  // namespace
}  // namespace terracut::stage
