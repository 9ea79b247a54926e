// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/parameter_table.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace terracut::ground {
namespace {

/// The method's and its baselines'.
std::vector<Parameter> all_parameters() {
  std::vector<Parameter> all(parameters().begin(), parameters().end());
  all.insert(all.end(), baseline_parameters().begin(), baseline_parameters().end());
  return all;
}

TEST(ParameterTable, KeepsTheBaselinesApart) {
  for (const Parameter& p : parameters()) {
    MethodConfig config;
    p.set(config, p.get(config) == p.least ? p.most : p.least);
    EXPECT_NE(p.get(config), p.get(MethodConfig(terracut_profile())))
        << p.key << " is not the method's own";
    EXPECT_EQ(p.get(MethodConfig(config.segmenter)), p.get(config)) << p.key;
  }
  for (const Parameter& p : baseline_parameters()) {
    MethodConfig config;
    p.set(config, p.get(config) == p.least ? p.most : p.least);
    EXPECT_EQ(p.get(MethodConfig(config.segmenter)), p.get(MethodConfig())) << p.key;
  }
}

TEST(ParameterTable, TellsWhichMethodLooksAtAParameter) {
  for (const Parameter& p : parameters()) {
    EXPECT_EQ(kind_that_uses(p.key), MethodKind::kSegmenter) << p.key;
  }
  for (const Parameter& p : baseline_parameters()) {
    // The methods are called as the keys begin.
    const auto method = method_named(p.key.substr(0, p.key.find('.')));
    ASSERT_TRUE(method) << p.key;
    EXPECT_EQ(kind_that_uses(p.key), method->kind) << p.key;
  }
}

TEST(ParameterTable, BothProfilesLieWithinTheRanges) {
  for (const MethodConfig& config :
       {MethodConfig(terracut_profile()), MethodConfig(paper_profile())}) {
    for (const Parameter& p : all_parameters()) {
      EXPECT_GE(p.get(config), p.least) << p.key;
      EXPECT_LE(p.get(config), p.most) << p.key;
    }
  }
}

TEST(ParameterTable, EveryKeyIsUniqueAndSetsAFieldOfItsOwn) {
  std::set<std::string_view> keys;
  for (const Parameter& p : all_parameters()) {
    EXPECT_TRUE(keys.insert(p.key).second) << p.key;
    MethodConfig config;
    const double other = p.get(config) == p.least ? p.most : p.least;
    p.set(config, other);
    for (const Parameter& q : all_parameters()) {
      const double expected = q.key == p.key ? other : q.get(MethodConfig{});
      EXPECT_NEAR(q.get(config), expected, 1e-6 * std::abs(expected))
          << p.key << " changed " << q.key;
    }
  }
}

TEST(ParameterTable, ReadsBackWhatItPrints) {
  for (const Parameter& p : all_parameters()) {
    MethodConfig config = paper_profile();
    const double before = p.get(config);
    ASSERT_TRUE(set_parameter(config, p.key, value_text(p, config)).has_value()) << p.key;
    EXPECT_EQ(p.get(config), before) << p.key;
  }
}

TEST(ParameterTable, NamesWhatWouldHaveBeenValid) {
  MethodConfig config;
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
