// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// HDL-64E and RS-Ruby128 in dual return, and RS-Ruby128 in single return, in the simulated world.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <iostream>
#include <map>
#include <vector>

#include "calib/beams/angle.hpp"
#include "tools/lab/simulator/drive.hpp"
#include "tools/lab/world/materials.hpp"

namespace terracut::simulator {
namespace {

template <class EncoderTraits>
std::vector<SimulatedColumn<EncoderTraits>> drive(const SimulationConfig<EncoderTraits>& config) {
  std::vector<SimulatedColumn<EncoderTraits>> columns;
  const auto summary =
      simulate_drive(config, [&](const SimulatedColumn<EncoderTraits>& column) -> Status {
        columns.push_back(column);
        return {};
      });
  EXPECT_TRUE(summary) << summary.error().message;
  EXPECT_EQ(summary->columns, columns.size());
  return columns;
}

template <class EncoderTraits>
SimulationConfig<EncoderTraits> one_frame(const std::string& scene, packets::ReturnMode returns) {
  SimulationConfig<EncoderTraits> config;
  config.scene = scene;
  config.duration_s = 0.1;
  config.threads = 2;
  config.sensor.returns = returns;
  return config;
}

template <class EncoderTraits>
class DualReturn : public testing::Test {};
using Sensors = testing::Types<packets::Hdl64eEncoderTraits, packets::Ruby128EncoderTraits>;
TYPED_TEST_SUITE(DualReturn, Sensors);

/// Calls visit(strongest, last) for each laser of each firing, with raw == 0 for none.
template <class EncoderTraits, class Visit>
void for_each_pair(const std::vector<SimulatedColumn<EncoderTraits>>& columns, Visit&& visit) {
  constexpr std::size_t kStrongest = EncoderTraits::kStrongestFirst ? 0 : 1;
  for (std::size_t i = 0; i + 1 < columns.size(); i += 2) {
    for (std::size_t laser = 0; laser < std::size_t{EncoderTraits::kLasers}; ++laser) {
      visit(columns[i + kStrongest].wire.by_laser[laser],
            columns[i + 1 - kStrongest].wire.by_laser[laser]);
    }
  }
}

TYPED_TEST(DualReturn, PairsShareStampAndAzimuthAndFillWholePackets) {
  const auto columns = drive(one_frame<TypeParam>("flat", packets::ReturnMode::kDual));
  ASSERT_EQ(columns.size() % 6, 0U);
  for (std::size_t i = 0; i < columns.size(); i += 2) {
    ASSERT_EQ(columns[i].wire.stamp_ns, columns[i + 1].wire.stamp_ns);
    ASSERT_EQ(columns[i].wire.unwrapped_azimuth_cdeg, columns[i + 1].wire.unwrapped_azimuth_cdeg);
    if (i == 0) continue;
    ASSERT_EQ(columns[i].wire.stamp_ns - columns[i - 1].wire.stamp_ns,
              TypeParam::firing_ns(packets::ReturnMode::kDual));
    ASSERT_GT(columns[i].wire.unwrapped_azimuth_cdeg, columns[i - 1].wire.unwrapped_azimuth_cdeg);
  }
}

TYPED_TEST(DualReturn, BothReturnsAreThereOrNoneAndTheLastIsNeverNearer) {
  std::size_t pairs = 0, nearer = 0, halves = 0, same = 0, told_apart = 0;
  for_each_pair(drive(one_frame<TypeParam>("street", packets::ReturnMode::kDual)),
                [&](const packets::LabelledReturn& strongest, const packets::LabelledReturn& last) {
                  halves += (strongest.raw == 0) != (last.raw == 0) ? 1 : 0;
                  if (strongest.raw == 0) return;
                  ++pairs;
                  nearer += last.raw < strongest.raw ? 1 : 0;
                  same += last.raw == strongest.raw ? 1 : 0;
                  told_apart += last.truth != strongest.truth ? 1 : 0;
                });
  EXPECT_EQ(halves, 0U);
  EXPECT_EQ(nearer, 0U);
  EXPECT_GT(pairs, 90'000U);
  // Where there is one surface only, the second return repeats the first.
  EXPECT_GT(same, pairs * 9 / 10);
  EXPECT_GT(pairs - same, pairs / 500);
  EXPECT_GT(told_apart, 100U);
}

TYPED_TEST(DualReturn, EchoesOfABeamAreFarEnoughApartToBeTold) {
  auto config = one_frame<TypeParam>("street", packets::ReturnMode::kDual);
  config.effects = SensorEffects::none();
  const double metres = TypeParam::metres_per_count(config.calibration);
  double nearest_m = 1e9;
  for_each_pair(drive(config),
                [&](const packets::LabelledReturn& strongest, const packets::LabelledReturn& last) {
                  if (last.raw > strongest.raw) {
                    nearest_m = std::min(nearest_m, (last.raw - strongest.raw) * metres);
                  }
                });
  EXPECT_GT(nearest_m, 0.7);  // 0.75 m along the beam, a little less where it is bent
}

TYPED_TEST(DualReturn, TwoEchoesComeFromEdgesAndLeavesNotFromTheOpenGround) {
  auto config = one_frame<TypeParam>("street", packets::ReturnMode::kDual);
  config.effects = SensorEffects::none();
  std::map<std::uint32_t, std::size_t> split, all;
  for_each_pair(drive(config),
                [&](const packets::LabelledReturn& strongest, const packets::LabelledReturn& last) {
                  if (strongest.raw == 0) return;
                  ++all[strongest.truth];
                  if (last.raw != strongest.raw) ++split[strongest.truth];
                });
  const auto share = [&](world::Truth truth) {
    const auto key = static_cast<std::uint32_t>(truth);
    return static_cast<double>(split[key]) /
           static_cast<double>(std::max<std::size_t>(1, all[key]));
  };
  std::cout << fmt::format("split: {:.2f} % of beams on the road, {:.1f} % on vegetation\n",
                           100 * share(world::Truth::kRoad),
                           100 * share(world::Truth::kVegetation));
  EXPECT_LT(share(world::Truth::kRoad), 0.01);
  EXPECT_GT(share(world::Truth::kVegetation), 5 * share(world::Truth::kRoad));
  EXPECT_GT(share(world::Truth::kVegetation), 0.03);
}

TYPED_TEST(DualReturn, IsTheSameOnAnyNumberOfThreads) {
  auto config = one_frame<TypeParam>("street", packets::ReturnMode::kDual);
  const auto digest = [](const auto& columns) {
    std::uint64_t sum = 0;
    for (const auto& column : columns) {
      for (const packets::LabelledReturn& beam : column.wire.by_laser) {
        sum = sum * 0x9E3779B97F4A7C15U + beam.raw * 3U + beam.intensity * 5U + beam.truth;
      }
    }
    return sum;
  };
  config.threads = 1;
  const std::uint64_t alone = digest(drive(config));
  config.threads = 3;
  EXPECT_EQ(digest(drive(config)), alone);
}

TEST(Ruby128Drive, TheAxisOfABeamMeasuresInDualReturnWhatItDoesInSingle) {
  const auto single =
      drive(one_frame<packets::Ruby128EncoderTraits>("street", packets::ReturnMode::kSingle));
  const auto dual =
      drive(one_frame<packets::Ruby128EncoderTraits>("street", packets::ReturnMode::kDual));
  std::size_t returns = 0, among_the_two = 0, strongest = 0;
  for (std::size_t i = 0; i < std::min(single.size(), dual.size() / 2); ++i) {
    ASSERT_EQ(single[i].wire.unwrapped_azimuth_cdeg, dual[2 * i].wire.unwrapped_azimuth_cdeg);
    for (std::size_t c = 0; c < 128; ++c) {
      const auto raw = single[i].wire.by_laser[c].raw;
      if (raw == 0) continue;
      ++returns;
      // The step, and with it the head's place, may round differently by 0.005 degrees.
      const auto near_to = [&](int other) { return std::abs(other - int{raw}) <= 40; };
      const bool is_last = near_to(dual[2 * i].wire.by_laser[c].raw);
      const bool is_strongest = near_to(dual[2 * i + 1].wire.by_laser[c].raw);
      among_the_two += is_last || is_strongest ? 1 : 0;
      strongest += is_strongest ? 1 : 0;
    }
  }
  EXPECT_GT(returns, 100'000U);
  EXPECT_GT(among_the_two, returns * 98 / 100);
  EXPECT_GT(strongest, returns * 95 / 100);
}

TEST(Ruby128Drive, GroundOfTheFlatSceneIsExactlyTheMountingHeightBelow) {
  auto config = one_frame<packets::Ruby128EncoderTraits>("flat", packets::ReturnMode::kSingle);
  config.effects = SensorEffects::none();
  config.mount.height_m = 2.1;
  std::size_t ground = 0;
  for (const auto& column : drive(config)) {
    for (std::size_t c = 0; c < 128; ++c) {
      if (column.wire.by_laser[c].truth != static_cast<std::uint32_t>(world::Truth::kRoad))
        continue;
      ++ground;
      ASSERT_NEAR(column.exact[c].z_m, -2.1, 1e-6);
    }
  }
  EXPECT_GT(ground, 80'000U);
}

TEST(Ruby128Drive, FiresEvery55MicrosecondsAtAnySpinAndSeesWholeFrames) {
  for (const double spin_hz : {5.0, 10.0, 20.0}) {
    auto config = one_frame<packets::Ruby128EncoderTraits>("flat", packets::ReturnMode::kSingle);
    config.spin_hz = spin_hz;
    config.duration_s = 1 / spin_hz;
    config.effects = SensorEffects::none();
    const auto columns = drive(config);
    EXPECT_EQ(columns.size() % 3, 0U);
    EXPECT_LT(columns.front().wire.unwrapped_azimuth_cdeg, -1'000);
    EXPECT_GT(columns.back().wire.unwrapped_azimuth_cdeg, beams::kRevolution_cdeg + 1'000);
    std::size_t lowest = 0;  // channel 36 points 25 degrees down and always meets the ground
    for (std::size_t i = 0; i < columns.size(); ++i) {
      lowest += columns[i].wire.by_laser[35].raw != 0 ? 1 : 0;
      if (i == 0) continue;
      ASSERT_EQ(columns[i].wire.stamp_ns - columns[i - 1].wire.stamp_ns, 55'550);
      ASSERT_NEAR(static_cast<double>(columns[i].wire.unwrapped_azimuth_cdeg -
                                      columns[i - 1].wire.unwrapped_azimuth_cdeg),
                  spin_hz * 36'000 * 55.55e-6, 1.0);
    }
    EXPECT_NEAR(static_cast<double>(lowest), 18'001.8 / spin_hz, 1.5);
  }
}

}  // namespace
}  // namespace terracut::simulator
