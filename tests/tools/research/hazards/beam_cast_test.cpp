// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/hazards/beam_cast.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <optional>

#include "tools/lab/world/shape_makers.hpp"

namespace terracut::hazards {
namespace {

constexpr double kHeight_m = 1.73;
constexpr double kNoise_m = 6 * 0.015;
constexpr world::Substance kThing{world::Truth::kFence, world::Material::kWood};

/// Ground returns on the x axis at the given distances, seen from 1.73 m above.
LabelledFrame ground_at(std::initializer_list<double> distances_m) {
  LabelledFrame frame;
  frame.sensor = {0, 0, kHeight_m};
  for (const double x_m : distances_m) {
    frame.at.emplace_back(x_m, 0, 0);
    frame.range_m.push_back(std::hypot(x_m, kHeight_m));
    frame.beam.push_back(Eigen::Vector3d(x_m, 0, -kHeight_m) / frame.range_m.back());
    frame.ground.emplace_back(GroundKind::kRoad);
  }
  return frame;
}

Eigen::Isometry3d at(double x_m) {
  return Eigen::Isometry3d(Eigen::Translation3d(x_m, 0, 0));
}

/// Returns where on the x axis return `index` lies now; none if it stayed.
std::optional<double> x_of(const LabelledFrame& frame, const MovedReturns& moved,
                           std::uint32_t index) {
  for (const MovedReturn& one : moved) {
    if (one.index == index) return (frame.sensor + one.range_m * frame.beam[index]).x();
  }
  return std::nullopt;
}

bool counts(const MovedReturns& moved, std::uint32_t index) {
  for (const MovedReturn& one : moved) {
    if (one.index == index) return one.counts;
  }
  return false;
}

// Half a metre long and wide, 0.3 m high, 9.75 to 10.25 m away. A beam that meets the ground at d
// is 1.73 (1 - x / d) high at x, so 0.3 m high at 0.8266 d: it meets the front for d up to 11.80 m
// and the top for d up to 12.40 m.
TEST(BeamCast, MovesReturnsToTheFrontAndTopOfABoxAndNoOthers) {
  const LabelledFrame frame = ground_at({9.7, 9.8, 10.2, 11.7, 12.1, 12.5, 30});
  const Hazard box{.body = {world::box({0, 0, 0}, {0.5, 0.5, 0.3}, kThing)}};
  const MovedReturns moved = put_in(frame, box, at(10), 7);
  EXPECT_FALSE(x_of(frame, moved, 0)) << "ends before it";
  EXPECT_NEAR(x_of(frame, moved, 1).value(), 9.75, kNoise_m);
  EXPECT_NEAR(x_of(frame, moved, 2).value(), 9.75, kNoise_m);
  EXPECT_NEAR(x_of(frame, moved, 3).value(), 9.75, kNoise_m);
  EXPECT_NEAR(x_of(frame, moved, 4).value(), 12.1 * (1 - 0.3 / kHeight_m), kNoise_m);
  EXPECT_FALSE(x_of(frame, moved, 5)) << "passes above it";
  EXPECT_FALSE(x_of(frame, moved, 6));
  // At the front they are 0.009, 0.076, 0.288 and, on the top, 0.3 m high.
  EXPECT_FALSE(counts(moved, 1)) << "as good as ground";
  EXPECT_TRUE(counts(moved, 2));
  EXPECT_TRUE(counts(moved, 3));
  EXPECT_TRUE(counts(moved, 4));
}

TEST(BeamCast, KeepsReturnsOfWhatStandsBeforeTheHazard) {
  LabelledFrame frame = ground_at({12});
  frame.range_m[0] = 8;
  const Hazard box{.body = {world::box({0, 0, 0}, {0.5, 0.5, 0.3}, kThing)}};
  EXPECT_TRUE(put_in(frame, box, at(10), 7).empty());
}

TEST(BeamCast, WhatComesWithAHazardHidesAndDoesNotCount) {
  const LabelledFrame frame = ground_at({11.5});
  const Hazard hidden{.body = {world::box({0, 0, 0}, {0.5, 0.5, 0.3}, kThing)},
                      .beside = {world::box({-1, 0, 0}, {0.5, 0.5, 2}, kThing)}};
  const MovedReturns moved = put_in(frame, hidden, at(10), 7);
  EXPECT_NEAR(x_of(frame, moved, 0).value(), 8.75, kNoise_m);
  EXPECT_FALSE(counts(moved, 0));
}

TEST(BeamCast, AHoleEndsBeamsAtItsFarWall) {
  const LabelledFrame frame = ground_at({9.6, 9.7, 10.3, 10.4});
  Hazard hazard;
  hazard.hole = world::post({0, 0, -1.5}, 0.35, 1.5, kThing);
  const MovedReturns moved = put_in(frame, hazard, at(10), 7);
  EXPECT_FALSE(x_of(frame, moved, 0));
  EXPECT_NEAR(x_of(frame, moved, 1).value(), 10.35, kNoise_m);
  EXPECT_NEAR(x_of(frame, moved, 2).value(), 10.35, kNoise_m);
  EXPECT_FALSE(x_of(frame, moved, 3));
  EXPECT_TRUE(counts(moved, 1));
}

TEST(BeamCast, TwigsLetSomeBeamsPass) {
  LabelledFrame frame = ground_at({});
  for (int i = 0; i < 1000; ++i) {
    const LabelledFrame one = ground_at({11.5});
    frame.at.push_back(one.at[0]);
    frame.range_m.push_back(one.range_m[0]);
    frame.beam.push_back(one.beam[0]);
    frame.ground.push_back(one.ground[0]);
  }
  world::Substance leaves = kThing;
  leaves.density_per_m = 2;
  const Hazard bush{.body = {world::box({0, 0, 0}, {0.5, 0.5, 1}, leaves)}};
  // The way through it is 0.5 m long, but for the slope of the beam.
  EXPECT_NEAR(static_cast<double>(put_in(frame, bush, at(10), 7).size()) / 1000,
              1 - std::exp(-2 * 0.5), 0.06);
}

}  // namespace
}  // namespace terracut::hazards
