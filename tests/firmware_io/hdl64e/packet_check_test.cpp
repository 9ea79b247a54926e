// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/packet_check.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "firmware_io/capture/capture_source.hpp"
#include "random_drive.hpp"
#include "tests/support/places.hpp"

namespace terracut::hdl64e {
namespace {

test::Packet good_packet() {
  return test::random_packets({.last_cdeg = 35'000}).front();
}

std::optional<frame::Reject> check(const test::Packet& packet) {
  packet::PacketAzimuths azimuths;
  return check_hdl64e_packet(packet.bytes, azimuths);
}

void set_ids(test::Packet& packet, std::initializer_list<unsigned> cycle) {
  for (std::size_t block = 0; block < 12; ++block) {
    packet.set_u16(100 * block, *(cycle.begin() + block % cycle.size()));
  }
}

void set_azimuths(test::Packet& packet, std::array<unsigned, 6> azimuth_cdeg) {
  for (std::size_t c = 0; c < 6; ++c) {
    packet.set_u16(200 * c + 2, azimuth_cdeg[c]);
    packet.set_u16(200 * c + 102, azimuth_cdeg[c]);
  }
}

TEST(PacketCheck, TakesAGoodPacketAndReadsItsAzimuths) {
  test::Packet packet = good_packet();
  set_azimuths(packet, {35'950, 35'967, 35'984, 2, 19, 36});
  packet.set_device_stamp_us(3'599'999'900U);
  packet::PacketAzimuths azimuths;
  ASSERT_EQ(check_hdl64e_packet(packet.bytes, azimuths), std::nullopt);
  EXPECT_EQ(azimuths.device_stamp_us, 3'599'999'900);
  EXPECT_EQ(azimuths.columns, 6);
  EXPECT_EQ(azimuths.first_cdeg(), 35'950);
  EXPECT_EQ(azimuths.last_cdeg(), 36);
  EXPECT_EQ(azimuths.step_ticks, 17'200);  // 86 hundredths of a degree over five steps
  EXPECT_EQ(azimuths.advance_cdeg(3), 52);
  EXPECT_FALSE(azimuths.dual_return);
}

TEST(PacketCheck, TakesTheHighestAzimuthOfTheWire) {
  test::Packet packet = good_packet();
  set_azimuths(packet, {35'913, 35'930, 35'947, 35'964, 35'982, 35'999});
  EXPECT_EQ(packet.bytes[1002], 0x9F);  // 359.99 degrees is 9F 8C on the wire
  EXPECT_EQ(packet.bytes[1003], 0x8C);
  EXPECT_EQ(check(packet), std::nullopt);
}

TEST(PacketCheck, RefusesEveryOtherSize) {
  const test::Packet packet = good_packet();
  packet::PacketAzimuths azimuths;
  for (const std::size_t size : {0U, 1U, 42U, 512U, 1205U}) {
    EXPECT_EQ(check_hdl64e_packet(std::span(packet.bytes).first(size), azimuths),
              frame::Reject::kWrongSize);
  }
  std::array<std::uint8_t, 1248> longer{};
  EXPECT_EQ(check_hdl64e_packet(longer, azimuths), frame::Reject::kWrongSize);
}

TEST(PacketCheck, KnowsARubyPacketByItsLeader) {
  std::array<std::uint8_t, 1248> ruby{0x55, 0xAA, 0x05, 0x5A};
  packet::PacketAzimuths azimuths;
  EXPECT_EQ(check_hdl64e_packet(ruby, azimuths), frame::Reject::kWrongModel);
}

TEST(PacketCheck, KnowsOtherVelodyneModelsByTheirBlocks) {
  test::Packet packet = good_packet();
  set_ids(packet, {0xEEFF});  // VLP-16, HDL-32E, VLP-32C
  EXPECT_EQ(check(packet), frame::Reject::kWrongModel);
  set_ids(packet, {0xEEFF, 0xDDFF, 0xCCFF, 0xBBFF});  // VLS-128
  EXPECT_EQ(check(packet), frame::Reject::kWrongModel);
  set_ids(packet, {0xEEFF, 0xEEFF, 0xEEFF, 0xDDFF});  // HDL-64E S1
  EXPECT_EQ(check(packet), frame::Reject::kWrongModel);
}

TEST(PacketCheck, RefusesBlockIdsOfNobody) {
  test::Packet packet = good_packet();
  packet.set_u16(700, 0xEEFE);
  EXPECT_EQ(check(packet), frame::Reject::kWrongMagic);
  set_ids(packet, {0xDDFF, 0xEEFF});
  EXPECT_EQ(check(packet), frame::Reject::kWrongMagic);
  set_ids(packet, {0});
  EXPECT_EQ(check(packet), frame::Reject::kWrongMagic);
}

TEST(PacketCheck, IgnoresTheStatusByteThatOtherDriversTakeForAModel) {
  test::Packet packet = good_packet();
  packet.bytes[1205] = 0xA1;  // the VLS-128's product number
  EXPECT_EQ(check(packet), std::nullopt);
}

TEST(PacketCheck, RefusesAzimuthsPastTheCircle) {
  for (const std::size_t block : {0U, 5U, 11U}) {
    test::Packet packet = good_packet();
    packet.set_u16(100 * block + 2, 36'000);
    EXPECT_EQ(check(packet), frame::Reject::kAzimuthOutOfRange);
  }
}

TEST(PacketCheck, RefusesAPairThatDisagrees) {
  test::Packet packet = good_packet();
  packet.set_u16(302, static_cast<unsigned>(packet.bytes[202] + 256 * packet.bytes[203] + 1));
  EXPECT_EQ(check(packet), frame::Reject::kAzimuthMismatch);
}

TEST(PacketCheck, RefusesJumpsInsideAPacketEitherWay) {
  test::Packet packet = good_packet();
  set_azimuths(packet, {100, 117, 134, 300, 317, 334});
  EXPECT_EQ(check(packet), frame::Reject::kAzimuthJump);
  set_azimuths(packet, {100, 117, 134, 100, 117, 134});
  EXPECT_EQ(check(packet), frame::Reject::kAzimuthJump);
  set_azimuths(packet, {100, 96, 92, 88, 84, 80});  // turning backwards
  EXPECT_EQ(check(packet), frame::Reject::kAzimuthJump);
}

TEST(PacketCheck, TakesAJitterBackwards) {
  test::Packet packet = good_packet();
  set_azimuths(packet, {100, 117, 114, 134, 151, 168});
  EXPECT_EQ(check(packet), std::nullopt);
}

TEST(PacketCheck, CallsAHeadThatDoesNotRotateStationary) {
  test::Packet packet = good_packet();
  set_azimuths(packet, {100, 100, 100, 100, 100, 100});
  EXPECT_EQ(check(packet), frame::Reject::kStationary);
  set_azimuths(packet, {35'999, 0, 35'999, 0, 35'999, 0});
  EXPECT_EQ(check(packet), frame::Reject::kStationary);
}

TEST(PacketCheck, SeesDualReturnAndItsLongerSteps) {
  test::Packet packet = good_packet();
  set_azimuths(packet, {100, 100, 121, 121, 142, 142});
  packet::PacketAzimuths azimuths;
  ASSERT_EQ(check_hdl64e_packet(packet.bytes, azimuths), std::nullopt);
  EXPECT_TRUE(azimuths.dual_return);
  EXPECT_EQ(azimuths.step_ticks, 21'000);
}

TEST(PacketCheck, SeesNoDualReturnWhereOnlySomePairsStandStill) {
  using Azimuths = std::array<unsigned, 6>;
  for (const Azimuths& jittering : {Azimuths{100, 100, 134, 134, 168, 185},
                                    {100, 100, 134, 151, 168, 168},
                                    {100, 117, 134, 134, 168, 168}}) {
    test::Packet packet = good_packet();
    set_azimuths(packet, jittering);
    packet::PacketAzimuths azimuths;
    ASSERT_EQ(check_hdl64e_packet(packet.bytes, azimuths), std::nullopt);
    EXPECT_FALSE(azimuths.dual_return)
        << jittering[1] << ", " << jittering[3] << ", " << jittering[5];
  }
}

class RealCapture : public testing::TestWithParam<const char*> {};

TEST_P(RealCapture, OfAnotherModelIsRefusedAsThat) {
  const auto path = test::shared_data("pcap") / GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  auto source = capture::CaptureSource::open(path);
  ASSERT_TRUE(source) << source.error().message;
  std::size_t data_packets = 0;
  while (true) {
    const auto datagram = source->next();
    ASSERT_TRUE(datagram) << datagram.error().message;
    if (!*datagram) break;
    packet::PacketAzimuths azimuths;
    const auto reason = check_hdl64e_packet((*datagram)->payload, azimuths);
    if ((*datagram)->payload.size() == kHdl64ePacketBytes) {
      ++data_packets;
      EXPECT_EQ(reason, frame::Reject::kWrongModel);
    } else {
      EXPECT_EQ(reason, frame::Reject::kWrongSize);
    }
  }
  EXPECT_GT(data_packets, 0U);
}

INSTANTIATE_TEST_SUITE_P(Shared, RealCapture,
                         testing::Values("sample_velodyne_hdl32.pcap",
                                         "sample_velodyne_vlp16_gps.pcap", "vlp16_nebula.pcap",
                                         "vlp32_nebula.pcap", "vls128_nebula.pcap"),
                         [](const auto& case_info) {
                           std::string name = case_info.param;
                           name.resize(name.size() - 5);
                           return name;
                         });

}  // namespace
}  // namespace terracut::hdl64e
