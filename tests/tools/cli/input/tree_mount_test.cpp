// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/input/tree_mount.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calib/beams/angle.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;

/// A sensor 2 m above base_link, which is 0.3 m above base_footprint; 10 degrees down in front.
bag::TransformTree robot() {
  const double half_rad = beams::deg_to_rad(5.0);
  bag::TransformTree tree;
  tree.set("base_link", "lidar", {1, 0, 2}, {0, std::sin(half_rad), 0, std::cos(half_rad)});
  tree.set("base_footprint", "base_link", {0, 0, 0.3}, {0, 0, 0, 1});
  return tree;
}

TEST(TreeMount, IsAboveTheFrameThatLiesOnTheGround) {
  const auto found = mount_in(robot(), "lidar", "", "/tf_static");
  ASSERT_TRUE(found && found->mount);
  EXPECT_NEAR(found->mount->height_m, 2.3, 1e-9);
  EXPECT_NEAR(found->mount->pitch_rad, beams::deg_to_rad(10.0), 1e-9);
  EXPECT_NEAR(found->mount->roll_rad, 0, 1e-9);
  EXPECT_THAT(found->note, HasSubstr("lidar stands 2.300 m above base_footprint"));
  EXPECT_THAT(found->note, HasSubstr("by /tf_static"));
}

TEST(TreeMount, IsAboveTheFrameThatWasNamed) {
  const auto found = mount_in(robot(), "lidar", "base_link", "/tf_static");
  ASSERT_TRUE(found && found->mount);
  EXPECT_NEAR(found->mount->height_m, 2, 1e-9);
  EXPECT_FALSE(mount_in(robot(), "lidar", "chassis", "/tf_static"));
  EXPECT_FALSE(mount_in(robot(), "camera", "", "/tf_static"));
}

TEST(TreeMount, OfAHeightThatIsNoneSaysSo) {
  const auto found = mount_in(robot(), "base_link", "base_link", "/tf_static");
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->mount);
  EXPECT_THAT(found->note, HasSubstr("not taken from /tf_static"));
}

TEST(TreeMount, FillsInWhatIsNotStated) {
  MountOptions stated;
  stated.height_m = 1.5;
  const MountOptions filled = filled_in(stated, mount::Mount{2, 0, beams::deg_to_rad(10.0)});
  EXPECT_EQ(*filled.height_m, 1.5);
  EXPECT_NEAR(*filled.roll_deg, 0, 1e-9);
  EXPECT_NEAR(*filled.pitch_deg, 10, 1e-9);
}

}  // namespace
}  // namespace terracut::cli
