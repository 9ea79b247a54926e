// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/sensor_probe.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/firmware_io/hdl64e/random_drive.hpp"

namespace terracut::sensor {
namespace {

int columns_of(double spin_hz, std::int64_t column_ns, std::size_t every = 1) {
  const auto packets =
      test::random_packets({.step_deg = 360 * spin_hz * static_cast<double>(column_ns) * 1e-9,
                            .column_ns = column_ns,
                            .share_of_returns = 0});
  SensorProbe probe;
  for (std::size_t n = 0; n < packets.size(); n += every) probe.add({.payload = packets[n].bytes});
  EXPECT_NEAR(probe.spin_hz(SensorModel::kHdl64e), spin_hz, 0.02);
  return probe.columns(SensorModel::kHdl64e);
}

TEST(SensorProbe, GivesAnHdl64eAsManyColumnsAsItFiresAFrame) {
  EXPECT_EQ(columns_of(10, 48'000), 2083);
  EXPECT_EQ(columns_of(20, 48'000), 1042);
}

TEST(SensorProbe, KnowsTheSlowerCycleOfSomeS3) {
  EXPECT_EQ(columns_of(10, 57'600), 1736);
  EXPECT_EQ(columns_of(5, 57'600), 3472);
}

TEST(SensorProbe, GivesAHeadThatKeepsNoNominalRateColumnsOfItsOwn) {
  EXPECT_EQ(columns_of(9.65, 48'000), 2159);  // KITTI's
  EXPECT_EQ(columns_of(9.8, 48'000), 2083);
}

TEST(SensorProbe, GivesAModelItHasNotHeardTheColumnsOfTenTurnsASecond) {
  EXPECT_EQ(SensorProbe().columns(SensorModel::kHdl64e), 2083);
  EXPECT_EQ(SensorProbe().columns(SensorModel::kRuby128), 1800);
  EXPECT_EQ(SensorProbe().columns(SensorModel::kPandarXt32), 2000);
}

/// Two firings each of a packet get the azimuth of the first of them, as in dual return.
void make_dual(test::Packet& packet) {
  constexpr std::size_t kBlockBytes = 100, kAzimuthAt = 2;
  for (std::size_t block = 0; block < 12; ++block) {
    const std::size_t from = block / 4 * 4;
    std::copy_n(&packet.bytes[from * kBlockBytes + kAzimuthAt], 2,
                &packet.bytes[block * kBlockBytes + kAzimuthAt]);
  }
}

TEST(SensorProbe, TakesTheReturnModeOfMostPackets) {
  const auto packets = test::random_packets({.share_of_returns = 0});
  const auto most_are_dual = [&](std::size_t dual_of_ten) {
    SensorProbe probe;
    for (std::size_t n = 0; n < 1000; ++n) {
      test::Packet packet = packets[n];
      if (n % 10 < dual_of_ten) make_dual(packet);
      probe.add({.payload = packet.bytes});
    }
    return probe.dual_return(SensorModel::kHdl64e);
  };
  EXPECT_FALSE(most_are_dual(0));
  EXPECT_FALSE(most_are_dual(4));
  EXPECT_TRUE(most_are_dual(6));
  EXPECT_TRUE(most_are_dual(10));
}

TEST(SensorProbe, IsNotDeceivedByLostPackets) {
  EXPECT_EQ(columns_of(10, 48'000, 2), 2083);
}

}  // namespace
}  // namespace terracut::sensor
