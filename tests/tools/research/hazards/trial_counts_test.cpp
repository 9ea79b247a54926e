// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/hazards/trial_counts.hpp"

#include <gtest/gtest.h>

#include "tools/research/hazards/labelled_frame.hpp"

namespace terracut::hazards {
namespace {

using datasets::Role;
using frame::Label;

TEST(SeenHazard, IsFoundByTwoReturnsAndThirtyPercentOfThem) {
  EXPECT_TRUE((SeenHazard{.returns = 6, .as_obstacle = 2}).is_found());
  EXPECT_FALSE((SeenHazard{.returns = 7, .as_obstacle = 2}).is_found());
  EXPECT_TRUE((SeenHazard{.returns = 10, .as_obstacle = 3}).is_found());
  EXPECT_FALSE((SeenHazard{.returns = 11, .as_obstacle = 3}).is_found());
  EXPECT_FALSE((SeenHazard{.returns = 1, .as_obstacle = 1}).is_found());
}

class TrialCountsTest : public testing::Test {
 protected:
  TrialCountsTest() {
    frame_.role = {Role::kGround, Role::kGround, Role::kKeyObstacle, Role::kGround,
                   Role::kGround, Role::kGround, Role::kGround,      Role::kIgnored};
    frame_.at.resize(frame_.role.size());
  }
  /// Returns 3, 4, 5 and 6 show the hazard, 1 is only hidden by it.
  const MovedReturns moved_{{1, 5, false}, {3, 5, true}, {4, 5, true}, {5, 5, true}, {6, 5, true}};
  LabelledFrame frame_;
};

TEST_F(TrialCountsTest, EverythingGroundSeesNothingOfIt) {
  const std::vector<Label> labels(8, Label::kGround);
  TrialCounts counts;
  counts.add(seen_hazard(moved_, labels), elsewhere(frame_, moved_, labels, labels));
  EXPECT_EQ(counts.trials, 1U);
  EXPECT_EQ(counts.found, 0U);
  EXPECT_EQ(counts.unseen, 1U);
  EXPECT_EQ(counts.returns, 4U);
  EXPECT_EQ(counts.as_obstacle, 0U);
  EXPECT_EQ(counts.elsewhere.after.recall_key_obstacles(), 0);
}

TEST_F(TrialCountsTest, EverythingObstacleFindsItAndHasNoGroundElsewhere) {
  const std::vector<Label> before(8, Label::kGround), after(8, Label::kObstacle);
  TrialCounts counts;
  counts.add(seen_hazard(moved_, after), elsewhere(frame_, moved_, before, after));
  EXPECT_EQ(counts.found, 1U);
  EXPECT_EQ(counts.unseen, 0U);
  EXPECT_EQ(counts.as_obstacle, 4U);
  EXPECT_EQ(counts.elsewhere.before.ground_as_ground, 1U) << "return 0; the others moved";
  EXPECT_EQ(counts.elsewhere.before.key_as_ground, 1U);
  EXPECT_EQ(counts.elsewhere.after.ground_as_obstacle, 1U);
  EXPECT_EQ(counts.elsewhere.after.key_as_obstacle, 1U);
}

}  // namespace
}  // namespace terracut::hazards
