// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/dds/ros_topic.hpp"

#include <gtest/gtest.h>

#include <string>

namespace terracut::dds {
namespace {

TEST(RosTopic, IsWhatRosCallsItOnTheNetwork) {
  EXPECT_EQ(dds_topic("/points_raw", "terracut"), "rt/points_raw");
  EXPECT_EQ(dds_topic("points_raw", "terracut"), "rt/points_raw");
  EXPECT_EQ(dds_topic("~/points", "terracut"), "rt/terracut/points");
  EXPECT_EQ(dds_topic("~/debug/cyclic_time_ms", "/left/ground"),
            "rt/left/ground/debug/cyclic_time_ms");
}

TEST(RosTopic, IsNothingOfWhatIsNoName) {
  for (const char* name : {"", "/", "a//b", "a/", "2d", "a/2d", "a-b", "a b", "~points", "~/",
                           "a/~/b", "rt/\xC3\xA4"}) {
    EXPECT_FALSE(dds_topic(name, "terracut")) << name;
  }
  EXPECT_FALSE(dds_topic("~/points", "a b"));
  EXPECT_FALSE(dds_topic(std::string(241, 'a'), "terracut"));
}

}  // namespace
}  // namespace terracut::dds
