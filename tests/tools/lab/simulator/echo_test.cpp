// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/simulator/echo.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace terracut::simulator {
namespace {

constexpr int kTrials = 20000;

double seen_share(const SensorEffects& effects, const world::Hit& hit, double cos_incidence) {
  world::Random random(5);
  int seen = 0;
  for (int i = 0; i < kTrials; ++i)
    seen += echo_from(effects, hit, cos_incidence, random).has_value();
  return seen / double{kTrials};
}

world::Hit hit_at(double way_m, world::Material material) {
  world::Hit hit;
  hit.way_m = way_m;
  hit.material = material;
  return hit;
}

TEST(Echo, RandomDropShareIsWhatWasAskedFor) {
  SensorEffects effects = SensorEffects::none();
  effects.random_drop_share = 0.2;
  EXPECT_NEAR(seen_share(effects, hit_at(10, world::Material::kFacade), 1), 0.8, 0.015);
}

TEST(Echo, NoEffectsMeansNoLossAndNoError) {
  world::Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const auto echo =
        echo_from(SensorEffects::none(), hit_at(119, world::Material::kGlass), 0.01, random);
    ASSERT_TRUE(echo);
    EXPECT_EQ(echo->range_error_m, 0);
  }
}

TEST(Echo, AsphaltFadesAtFiftyMetresAndAWallDoesNot) {
  SensorEffects effects;
  effects.random_drop_share = 0;
  const auto asphalt = [&](double way_m) {
    return seen_share(effects, hit_at(way_m, world::Material::kAsphalt), 1.73 / way_m);
  };
  EXPECT_GT(asphalt(15), 0.99);
  EXPECT_GT(asphalt(40), 0.6);
  EXPECT_LT(asphalt(75), 0.2);
  EXPECT_GT(seen_share(effects, hit_at(110, world::Material::kFacade), 0.7), 0.99);
}

TEST(Echo, GlassLosesMoreThanPaint) {
  const SensorEffects effects;
  EXPECT_LT(seen_share(effects, hit_at(10, world::Material::kGlass), 0.8), 0.5);
  EXPECT_GT(seen_share(effects, hit_at(10, world::Material::kLightPaint), 0.8), 0.9);
}

TEST(Echo, RangeNoiseHasTheAskedDeviation) {
  SensorEffects effects = SensorEffects::none();
  effects.range_noise_m = 0.03;
  world::Random random(9);
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < kTrials; ++i) {
    const double error_m =
        echo_from(effects, hit_at(10, world::Material::kFacade), 1, random)->range_error_m;
    sum += error_m;
    squares += error_m * error_m;
  }
  EXPECT_NEAR(sum / kTrials, 0, 0.001);
  EXPECT_NEAR(std::sqrt(squares / kTrials), 0.03, 0.001);
}

TEST(Echo, BrightSurfacesLookBright) {
  world::Random random(9);
  const auto intensity = [&](world::Material material) {
    return echo_from(SensorEffects::none(), hit_at(10, material), 1, random)->intensity;
  };
  EXPECT_GT(intensity(world::Material::kSign), 230);
  EXPECT_GT(intensity(world::Material::kRoadPaint), intensity(world::Material::kAsphalt) + 20);
}

}  // namespace
}  // namespace terracut::simulator
