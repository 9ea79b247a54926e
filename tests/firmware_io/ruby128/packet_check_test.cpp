// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/packet_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "firmware_io/capture/capture_source.hpp"
#include "random_stream.hpp"
#include "tests/support/places.hpp"

namespace terracut::ruby128 {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes packet_at(std::array<int, 3> azimuth_cdeg) {
  ruby128_wire::Packet packet = blank_packet();
  for (std::size_t b = 0; b < 3; ++b) {
    packet.blocks[b].azimuth_cdeg = static_cast<std::uint16_t>(azimuth_cdeg[b]);
  }
  const auto payload = payload_of(packet);
  return {payload.begin(), payload.end()};
}

std::optional<frame::Reject> check(const Bytes& payload) {
  packet::PacketAzimuths azimuths;
  return check_ruby128_packet(payload, azimuths);
}

packet::PacketAzimuths azimuths_of(std::array<int, 3> azimuth_cdeg) {
  packet::PacketAzimuths azimuths;
  EXPECT_EQ(check_ruby128_packet(packet_at(azimuth_cdeg), azimuths), std::nullopt);
  return azimuths;
}

TEST(Ruby128PacketCheck, ReadsTheHeadsOfASingleReturnPacketAcrossTheSeam) {
  const packet::PacketAzimuths azimuths = azimuths_of({35'970, 35'990, 11});
  EXPECT_FALSE(azimuths.dual_return);
  EXPECT_EQ(azimuths.columns, 3);
  EXPECT_EQ(azimuths.advance_cdeg(2), 41);
  EXPECT_EQ(azimuths.step_ticks, 20'500);
  EXPECT_EQ(azimuths.sweep_ticks, 61'500);
}

TEST(Ruby128PacketCheck, KnowsBothPacketsOfDualReturn) {
  const packet::PacketAzimuths pair_first = azimuths_of({100, 100, 120});
  EXPECT_TRUE(pair_first.dual_return);
  EXPECT_EQ(pair_first.step_ticks, 20'000);
  EXPECT_EQ(pair_first.sweep_ticks, 20'000);  // the firing at 120 is the next packet's
  const packet::PacketAzimuths pair_last = azimuths_of({120, 140, 140});
  EXPECT_TRUE(pair_last.dual_return);
  EXPECT_EQ(pair_last.step_ticks, 20'000);
  EXPECT_EQ(pair_last.sweep_ticks, 40'000);
}

TEST(Ruby128PacketCheck, KnowsWhatItsPacketsMayBeApart) {
  const packet::PacketAzimuths single = azimuths_of({100, 120, 140}),
                               dual = azimuths_of({100, 100, 120});
  EXPECT_EQ(single.nominal_period_ns, 166'650);
  EXPECT_EQ(dual.nominal_period_ns, 83'325);
  for (const packet::PacketAzimuths& azimuths : {single, dual}) {
    EXPECT_LT(azimuths.shortest_period_ns, azimuths.nominal_period_ns);
    EXPECT_GT(azimuths.longest_period_ns, azimuths.nominal_period_ns);
  }
  EXPECT_GT(single.shortest_period_ns, dual.longest_period_ns);
}

TEST(Ruby128PacketCheck, EvensOutStampsUpToTheLastOfAll) {
  const packet::PacketAzimuths pair_first = azimuths_of({100, 100, 120}),
                               pair_last = azimuths_of({120, 140, 140});
  EXPECT_EQ(ruby_even_stamp_us(5'000'000, pair_first, true), 5'000);
  EXPECT_EQ(ruby_even_stamp_us(5'000'000, pair_last, true), 5'027);  // half a firing later
  EXPECT_EQ(ruby_even_stamp_us(5'000'000, pair_last, false), 5'000);
  constexpr std::int64_t kMost_ns = std::numeric_limits<std::int64_t>::max();
  EXPECT_GT(ruby_even_stamp_us(kMost_ns, pair_last, true), kMost_ns / 1000 - 100);
}

packet::PacketAzimuths azimuths_across(std::array<int, 3> azimuth_cdeg) {
  packet::PacketAzimuths azimuths;
  EXPECT_EQ(check_ruby128_packet(packet_at(azimuth_cdeg), azimuths), frame::Reject::kAzimuthJump);
  EXPECT_TRUE(read_across_sector(azimuths, 20'000));
  return azimuths;
}

TEST(Ruby128PacketCheck, ReadsAPacketThatABlindSectorLiesIn) {
  const packet::PacketAzimuths late = azimuths_across({8'970, 8'990, 27'010});
  EXPECT_FALSE(late.dual_return);
  EXPECT_EQ(late.behind_sector, 2);
  EXPECT_EQ(late.advance_cdeg(1), 20);
  EXPECT_EQ(late.advance_cdeg(2), 18'040) << "the head rotates on, by more than half a revolution";
  EXPECT_EQ(late.sweep_ticks, 18'060'000) << "to the first firing of the next packet";
  EXPECT_EQ(late.pace_ticks, 60'000);
  EXPECT_EQ(late.sector_inside(8'970'000).from_ticks, 9'010'000);
  EXPECT_EQ(late.sector_inside(8'970'000).to_ticks, 27'010'000);
  EXPECT_NEAR(static_cast<double>(late.sector_ns()), 50e6, 0.1e6) << "of 10 Hz";

  const packet::PacketAzimuths early = azimuths_across({35'000, 10, 30});
  EXPECT_EQ(early.behind_sector, 1);
  EXPECT_EQ(early.sweep_ticks, 1'050'000);
  EXPECT_EQ(early.sector_inside(0).ticks(), 990'000);
}

TEST(Ruby128PacketCheck, ReadsBothPacketsOfDualReturnThatABlindSectorLiesIn) {
  const packet::PacketAzimuths pair_first = azimuths_across({8'990, 8'990, 27'010});
  EXPECT_TRUE(pair_first.dual_return);
  EXPECT_EQ(pair_first.behind_sector, 2);
  EXPECT_EQ(pair_first.sweep_ticks, 18'020'000) << "the firing at 270.1 is the next packet's";
  const packet::PacketAzimuths pair_last = azimuths_across({8'990, 27'010, 27'010});
  EXPECT_TRUE(pair_last.dual_return);
  EXPECT_EQ(pair_last.behind_sector, 1);
  EXPECT_EQ(pair_last.sweep_ticks, 18'040'000);
  EXPECT_EQ(pair_last.sector_inside(0).ticks(), 18'000'000);
}

TEST(Ruby128PacketCheck, FindsNoSectorInAzimuthsThatJumpTwiceNorWithoutAStep) {
  for (const auto& azimuth_cdeg : {std::array{100, 9'000, 18'000}, {100, 9'000, 120}}) {
    packet::PacketAzimuths azimuths;
    EXPECT_EQ(check_ruby128_packet(packet_at(azimuth_cdeg), azimuths), frame::Reject::kAzimuthJump);
    EXPECT_FALSE(read_across_sector(azimuths, 20'000));
  }
  packet::PacketAzimuths azimuths;
  EXPECT_EQ(check_ruby128_packet(packet_at({100, 9'000, 9'020}), azimuths),
            frame::Reject::kAzimuthJump);
  EXPECT_FALSE(read_across_sector(azimuths, 0));
}

TEST(Ruby128PacketCheck, TakesEverySpinRate) {
  for (const int step_cdeg : {10, 20, 40}) {
    EXPECT_EQ(azimuths_of({0, step_cdeg, 2 * step_cdeg}).step_ticks,
              step_cdeg * packet::kTicksPerCdeg);
  }
}

TEST(Ruby128PacketCheck, TellsAStandingHeadFromDualReturn) {
  EXPECT_EQ(check(packet_at({100, 100, 100})), frame::Reject::kStationary);
  EXPECT_EQ(check(packet_at({100, 101, 101})), frame::Reject::kStationary);
}

TEST(Ruby128PacketCheck, RefusesAzimuthsThatAreNone) {
  EXPECT_EQ(check(packet_at({35'980, 36'000, 20})), frame::Reject::kAzimuthOutOfRange);
  EXPECT_EQ(check(packet_at({65'535, 65'535, 65'535})), frame::Reject::kAzimuthOutOfRange);
  EXPECT_EQ(check(packet_at({100, 120, 18'000})), frame::Reject::kAzimuthJump);
  EXPECT_EQ(check(packet_at({100, 120, 100})), frame::Reject::kAzimuthJump);
}

TEST(Ruby128PacketCheck, NamesWhatIsNoDataPacket) {
  Bytes good = packet_at({100, 120, 140});
  EXPECT_EQ(check(good), std::nullopt);
  EXPECT_EQ(check({good.begin(), good.end() - 1}), frame::Reject::kWrongSize);
  EXPECT_EQ(check({}), frame::Reject::kWrongSize);

  Bytes other = good;
  other[3] = 0x5B;
  EXPECT_EQ(check(other), frame::Reject::kWrongMagic);
  other = good;
  other[80 + 388] = 0xFD;
  EXPECT_EQ(check(other), frame::Reject::kWrongMagic);
  other = good;
  other[81] = 0xD1;  // the return's number, not part of the id
  EXPECT_EQ(check(other), std::nullopt);

  Bytes device_info(kRubyPacketBytes, 0);
  const std::array<std::uint8_t, 8> start{0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55};
  std::copy(start.begin(), start.end(), device_info.begin());
  EXPECT_EQ(check(device_info), frame::Reject::kDeviceInfo);
}

TEST(Ruby128PacketCheck, RefusesItsRelativesByModel) {
  Bytes plus = packet_at({100, 120, 140});
  plus[31] = 5;
  plus[32] = 1;
  EXPECT_EQ(check(plus), frame::Reject::kWrongModel);

  Bytes lite(kRubyPacketBytes, 0);
  std::copy(kRubyMagic.begin(), kRubyMagic.end(), lite.begin());
  for (std::size_t block = 0; block < 4; ++block) lite[80 + 244 * block] = kRubyBlockId;
  EXPECT_EQ(check(lite), frame::Reject::kWrongModel);
}

class RealCapture : public testing::TestWithParam<const char*> {};

TEST_P(RealCapture, OfAnotherSensorIsRefusedByModel) {
  const std::filesystem::path path = test::shared_data("pcap") / GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  auto source = capture::CaptureSource::open(path);
  ASSERT_TRUE(source) << source.error().message;
  int data_packets = 0;
  while (true) {
    const auto next = source->next();
    ASSERT_TRUE(next) << next.error().message;
    if (!*next) break;
    packet::PacketAzimuths azimuths;
    const auto reason = check_ruby128_packet((*next)->payload, azimuths);
    ASSERT_TRUE(reason);
    if ((*next)->payload.size() == 1206) {
      EXPECT_EQ(*reason, frame::Reject::kWrongModel);
      ++data_packets;
    }
  }
  EXPECT_GT(data_packets, 0);
}

INSTANTIATE_TEST_SUITE_P(Shared, RealCapture,
                         testing::Values("vls128_nebula.pcap", "vlp32_nebula.pcap",
                                         "vlp16_nebula.pcap", "sample_velodyne_hdl32.pcap"),
                         [](const auto& file) {
                           std::string name = file.param;
                           name.resize(name.find('.'));
                           return name;
                         });

TEST(HeldFiring, GivesTheSecondReturnTheStepOfTheFirst) {
  HeldFiring held;
  EXPECT_EQ(held.join({100, 100, 120}, 20'000, 1000, false), 20'000);
  EXPECT_EQ(held.join({120, 141, 141}, 21'000, 1083, false), 20'000);
  EXPECT_EQ(held.join({161, 161, 181}, 20'000, 1166, false), 20'000);
}

TEST(HeldFiring, IsKeptForAsLongAsABlindSectorInItsPacketTakes) {
  HeldFiring held;
  (void)held.join({8'990, 8'990, 27'010}, 20'000, 1000, true);
  EXPECT_EQ(held.join({27'010, 27'031, 27'031}, 21'000, 51'083, false), 20'000);
}

TEST(HeldFiring, DropsAFiringWhosePacketIsLost) {
  HeldFiring held;
  (void)held.join({100, 100, 120}, 20'000, 1000, false);
  EXPECT_EQ(held.join({180, 201, 201}, 21'000, 1249, false), 21'000);
  (void)held.join({100, 100, 120}, 20'000, 1000, false);
  EXPECT_EQ(held.join({120, 141, 141}, 21'000, 101'083, false),
            21'000);  // the same place, a frame later
  (void)held.join({100, 100, 120}, 20'000, 1000, false);
  held.reset();
  EXPECT_EQ(held.join({120, 141, 141}, 21'000, 1083, false), 21'000);
}

}  // namespace
}  // namespace terracut::ruby128
