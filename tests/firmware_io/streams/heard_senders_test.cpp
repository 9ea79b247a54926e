// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/streams/heard_senders.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "tests/firmware_io/hdl64e/random_drive.hpp"

namespace terracut::streams {
namespace {

using sensor::SensorModel;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::uint32_t kSensor = 0xC0A801C9, kOther = 0xC0A80107;  // 192.168.1.201 and .7
constexpr std::int64_t kMs = 1'000'000;

class HeardSendersTest : public testing::Test {
 protected:
  void hear(std::span<const test::Packet> packets, std::uint32_t from) {
    for (const test::Packet& packet : packets) {
      packet::Datagram datagram = packet.datagram();
      datagram.source_address = from;
      senders_.add(datagram);
    }
  }
  static std::vector<test::Packet> a_second() {
    return test::random_packets({.first_cdeg = 0, .last_cdeg = 360'000, .share_of_returns = 0.01});
  }

  HeardSenders senders_{std::nullopt};
  std::vector<test::Packet> packets_ = a_second();
};

TEST_F(HeardSendersTest, ASteadyStreamOfARotatingHeadIsASensor) {
  hear(std::span(packets_).first(20), kSensor);
  EXPECT_THAT(senders_.rotating(), IsEmpty());
  EXPECT_EQ(senders_.known_for_ns(), 0);
  hear(std::span(packets_).subspan(20), kSensor);
  ASSERT_THAT(senders_.rotating(), SizeIs(1));
  EXPECT_EQ(senders_.rotating().front().source_address, kSensor);
  EXPECT_EQ(senders_.rotating().front().model, sensor::SensorModel::kHdl64e);
  EXPECT_GT(senders_.known_for_ns(), 900 * kMs);
}

TEST_F(HeardSendersTest, AStrayPacketOfAnotherSenderIsNoSensor) {
  hear(std::span(packets_).first(1), kOther);
  hear(packets_, kSensor);
  EXPECT_THAT(senders_.rotating(), SizeIs(1));
  EXPECT_THAT(senders_.steady(), SizeIs(1));
  EXPECT_THAT(senders_.others(),
              testing::MatchesRegex("1 data packets of .*HDL-64E.* from 192.168.1.7"));
}

TEST_F(HeardSendersTest, OfAFewPacketsIsASensorOfACapture) {
  hear(std::span(packets_).first(20), kSensor);
  ASSERT_THAT(senders_.sensors(), SizeIs(1));
  EXPECT_EQ(senders_.sensors().front().source_address, kSensor);
  hear(packets_, kSensor);
  hear(std::span(packets_).first(1), kOther);
  EXPECT_THAT(senders_.sensors(), SizeIs(1)) << "a stray packet is none";
}

TEST_F(HeardSendersTest, TwoSteadyStreamsAreTwoSensors) {
  hear(packets_, kOther);
  hear(packets_, kSensor);
  EXPECT_THAT(senders_.rotating(), SizeIs(2));
}

TEST_F(HeardSendersTest, AHeadThatStandsIsNamedButNotKnown) {
  for (test::Packet& packet : packets_) {
    for (std::size_t block = 0; block < 12; ++block) packet.set_u16(100 * block + 2, 1234);
  }
  hear(packets_, kSensor);
  EXPECT_THAT(senders_.rotating(), IsEmpty());
  EXPECT_THAT(senders_.steady(), SizeIs(1));
  EXPECT_THAT(senders_.others(), HasSubstr(", whose head does not rotate, from 192.168.1.201"));
}

TEST_F(HeardSendersTest, ASensorOfAnotherModelThanWantedDoesNotCount) {
  senders_ = HeardSenders(sensor::SensorModel::kRuby128);
  hear(packets_, kSensor);
  EXPECT_THAT(senders_.rotating(), IsEmpty());
  EXPECT_THAT(senders_.steady(), IsEmpty());
  EXPECT_THAT(senders_.others(), HasSubstr(" packets of a Velodyne HDL-64E (S2/S3) from "));
}

TEST_F(HeardSendersTest, WhatIsNoPacketOfASensorIsCounted) {
  const std::vector<std::uint8_t> bytes(100);
  EXPECT_EQ(senders_.others(), "");
  for (int i = 0; i < 12; ++i) senders_.add({.payload = bytes, .source_address = kOther});
  EXPECT_EQ(senders_.others(),
            "12 datagrams of no sensor known here, 100 bytes to port 0, from 192.168.1.7");
}

TEST_F(HeardSendersTest, SendersOfDataPacketsAreNamedFirstAndFourInAll) {
  const std::vector<std::uint8_t> bytes(100);
  for (std::uint32_t n = 0; n < 5; ++n) {
    senders_.add({.payload = bytes, .source_address = 0x0A000000 + n});
  }
  hear(std::span(packets_).first(1), kOther);
  const std::string others = senders_.others();
  EXPECT_THAT(others, testing::StartsWith("1 data packets of Velodyne HDL-64E (S2/S3) from "));
  EXPECT_THAT(others, HasSubstr("from 10.0.0.2; 2 others"));
}

TEST_F(HeardSendersTest, WhatAModelThatIsNotReadIsLikeIsNamed) {
  std::vector<std::uint8_t> helios(1248), hesai(861);
  std::ranges::copy(std::array<std::uint8_t, 4>{0x55, 0xAA, 0x05, 0x5A}, helios.begin());
  for (std::size_t block = 0; block < 12; ++block) {
    helios[42 + 100 * block] = 0xFF;
    helios[43 + 100 * block] = 0xEE;
  }
  senders_.add({.payload = helios, .source_address = kOther});
  EXPECT_EQ(senders_.others(),
            "1 packets of another RoboSense (12 blocks of 32 channels, a Helios's; one with 32 "
            "lasers has to be named with --sensor) from 192.168.1.7");
  std::ranges::copy(std::array<std::uint8_t, 8>{0xEE, 0xFF, 1, 4, 0, 0, 128, 2}, hesai.begin());
  senders_.add({.payload = hesai, .source_address = kSensor});
  EXPECT_THAT(senders_.others(), HasSubstr("of a Hesai that is not read: 128 lasers"));
}

TEST_F(HeardSendersTest, ASensorIsHeardHoweverManyOthersSendOneByte) {
  const std::vector<std::uint8_t> byte(1);
  constexpr std::uint32_t kFirst = 0x0A000000, kMany = 1000;
  const auto babble = [&] {
    for (std::uint32_t n = 0; n < kMany; ++n) {
      senders_.add({.payload = byte, .source_address = kFirst + n});
    }
  };
  babble();
  EXPECT_THAT(senders_.others(),
              HasSubstr("; 936 datagrams of more addresses than are remembered"));
  EXPECT_LT(senders_.others().size(), 400U) << "not every one is named";
  for (std::size_t n = 0; n < packets_.size(); n += 500) {
    hear(std::span(packets_).subspan(n, std::min<std::size_t>(500, packets_.size() - n)), kSensor);
    babble();
  }
  ASSERT_THAT(senders_.rotating(), SizeIs(1));
  EXPECT_EQ(senders_.rotating().front().source_address, kSensor);
}

TEST_F(HeardSendersTest, ASensorIsHeardThoughManyPretendToBeOneAndThenAreSilent) {
  constexpr std::uint32_t kFirst = 0x0A000000, kMany = 1000;
  for (std::uint32_t n = 0; n < kMany; ++n) {
    hear(std::span(packets_).first(1), kFirst + n);
  }
  hear(packets_, kSensor);
  ASSERT_THAT(senders_.rotating(), SizeIs(1));
  EXPECT_EQ(senders_.rotating().front().source_address, kSensor);
}

}  // namespace
}  // namespace terracut::streams
