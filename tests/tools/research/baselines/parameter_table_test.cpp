// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/baselines/parameter_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "pipeline/ground/parameter_table.hpp"

namespace terracut::baselines {
namespace {

using testing::HasSubstr;

TEST(BaselineParameters, TellWhichMethodLooksAtThem) {
  for (const auto& p : ground::parameters()) {
    EXPECT_EQ(kind_that_uses(p.key), MethodKind::kSegmenter) << p.key;
  }
  for (const Parameter& p : parameters()) {
    // The methods are called as the keys begin.
    const auto method = method_named(p.key.substr(0, p.key.find('.')));
    ASSERT_TRUE(method) << p.key;
    EXPECT_EQ(kind_that_uses(p.key), method->kind) << p.key;
  }
}

TEST(BaselineParameters, EveryKeyIsUniqueAndSetsAFieldOfItsOwnWithinItsRange) {
  std::set<std::string_view> keys;
  for (const Parameter& p : parameters()) {
    EXPECT_TRUE(keys.insert(p.key).second) << p.key;
    MethodConfig config;
    EXPECT_GE(p.get(config), p.least) << p.key;
    EXPECT_LE(p.get(config), p.most) << p.key;
    const double other = p.get(config) == p.least ? p.most : p.least;
    p.set(config, other);
    for (const Parameter& q : parameters()) {
      const double expected = q.key == p.key ? other : q.get(MethodConfig{});
      EXPECT_NEAR(q.get(config), expected, 1e-6 * std::abs(expected))
          << p.key << " changed " << q.key;
    }
  }
}

TEST(BaselineParameters, AreSetByTheirKeysAsOurMethodsAre) {
  MethodConfig config;
  ASSERT_TRUE(apply_setting(config, "pfaff.cell_m=0.5"));
  EXPECT_FLOAT_EQ(config.pfaff.cell_m, 0.5F);
  ASSERT_TRUE(apply_setting(config, "region.lambda=2"));
  EXPECT_FLOAT_EQ(config.segmenter.region.lambda, 2);
}

TEST(BaselineParameters, RefusesWhatIsNoSettingAndNamesWhatWasMeant) {
  MethodConfig config;
  const auto refusal_of = [&](std::string_view setting) {
    const Status set = apply_setting(config, setting);
    return set ? std::string() : set.error().message;
  };
  EXPECT_THAT(refusal_of("pfaff.cell_m=0"), HasSubstr("from 0.05 to 10"));
  EXPECT_THAT(refusal_of("pfaf.cell_m=1"), HasSubstr("did you mean pfaff.cell_m?"));
  EXPECT_THAT(refusal_of("region.lamda=1"), HasSubstr("did you mean region.lambda?"));
  EXPECT_THAT(refusal_of("pfaff.cell_m"), HasSubstr("expected KEY=VALUE"));
}

}  // namespace
}  // namespace terracut::baselines
