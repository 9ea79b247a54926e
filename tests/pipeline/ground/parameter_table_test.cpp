// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/parameter_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string_view>

namespace terracut::ground {
namespace {

TEST(ParameterTable, BothProfilesLieWithinTheRanges) {
  for (const SegmenterConfig& config : {terracut_profile(), paper_profile()}) {
    for (const Parameter& p : parameters()) {
      EXPECT_GE(p.get(config), p.least) << p.key;
      EXPECT_LE(p.get(config), p.most) << p.key;
    }
  }
}

TEST(ParameterTable, EveryKeyIsUniqueAndSetsAFieldOfItsOwn) {
  std::set<std::string_view> keys;
  for (const Parameter& p : parameters()) {
    EXPECT_TRUE(keys.insert(p.key).second) << p.key;
    SegmenterConfig config;
    const double other = p.get(config) == p.least ? p.most : p.least;
    p.set(config, other);
    for (const Parameter& q : parameters()) {
      const double expected = q.key == p.key ? other : q.get(SegmenterConfig{});
      EXPECT_NEAR(q.get(config), expected, 1e-6 * std::abs(expected))
          << p.key << " changed " << q.key;
    }
  }
}

TEST(ParameterTable, SaysWhichParametersAProfileReads) {
  const auto is_read_by = [](std::string_view key, const SegmenterConfig& profile) {
    return is_read(*find_parameter(parameters(), key), profile);
  };
  for (const std::string_view key : {"surface.max_slope", "elevation_map.window_m",
                                     "adjacent.min_rise_m", "region.ramp_m", "boundary.scale_m"}) {
    EXPECT_TRUE(is_read_by(key, terracut_profile())) << key;
    EXPECT_FALSE(is_read_by(key, paper_profile())) << key;
  }
  for (const std::string_view key : {"region.bins_per_metre", "boundary.sigma"}) {
    EXPECT_FALSE(is_read_by(key, terracut_profile())) << key;
    EXPECT_TRUE(is_read_by(key, paper_profile())) << key;
  }
  EXPECT_TRUE(is_read_by("adjacent.max_slope_rad", paper_profile()));
}

TEST(ParameterTable, ReadsBackWhatItPrints) {
  for (const Parameter& p : parameters()) {
    SegmenterConfig config = paper_profile();
    const double before = p.get(config);
    ASSERT_TRUE(set_parameter(config, p.key, p.text(config)).has_value()) << p.key;
    EXPECT_EQ(p.get(config), before) << p.key;
  }
}

TEST(ParameterTable, NamesWhatWouldHaveBeenValid) {
  SegmenterConfig config;
  const Status range = set_parameter(config, "region.lambda", "-1");
  ASSERT_FALSE(range.has_value());
  EXPECT_NE(range.error().message.find("from 0.0001 to 1000"), std::string::npos)
      << range.error().message;
  const Status choice = set_parameter(config, "adjacent.rule", "steep");
  ASSERT_FALSE(choice.has_value());
  EXPECT_NE(choice.error().message.find("ring_spacing, slope"), std::string::npos);
  const Status key = set_parameter(config, "region.lamda", "1");
  ASSERT_FALSE(key.has_value());
  EXPECT_NE(key.error().message.find("region.lambda"), std::string::npos);
  for (const char* bad : {"", "nan", "inf", "1x", "0x10"}) {
    EXPECT_FALSE(set_parameter(config, "region.lambda", bad).has_value()) << bad;
  }
}

}  // namespace
}  // namespace terracut::ground
