// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/streams/sender_streams.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "firmware_io/velodyne/models.hpp"

namespace terracut::streams {
namespace {

using packet::Datagram;
using testing::SizeIs;

constexpr int kPackets = 100;

/// The data packets of a VLP-16 that rotates ten times a second.
class Unit {
 public:
  /// `ahead_us` and `ahead_cdeg`: its clock and its head, before those of others.
  explicit Unit(std::int64_t ahead_us = 0, int ahead_cdeg = 0, std::uint8_t range = 1)
      : ahead_us_(ahead_us), ahead_cdeg_(ahead_cdeg), range_(range) {}

  std::vector<std::uint8_t> packet(int number) const {
    constexpr std::int64_t kPeriod_ns = velodyne::Vlp16::kPace.column_ns * 12;
    hdl64e::wire::Packet packet{};
    const std::int64_t now_ns = number * kPeriod_ns;
    packet.stamp_us = static_cast<std::uint32_t>(1'000'000 + ahead_us_ + now_ns / 1000);
    packet.status_type = velodyne::kStrongest;
    packet.status_value = 0x22;
    for (std::size_t block = 0; block < packet.blocks.size(); ++block) {
      const auto turned = (number * 12 + static_cast<int>(block)) * 40 + ahead_cdeg_;
      packet.blocks[block].id = hdl64e::kUpperBlockId;
      packet.blocks[block].azimuth_cdeg = static_cast<std::uint16_t>(turned % 36'000);
      packet.blocks[block].returns[0].distance = range_;
    }
    const auto payload = hdl64e::payload_of(packet);
    return {payload.begin(), payload.end()};
  }

 private:
  std::int64_t ahead_us_;
  int ahead_cdeg_;
  std::uint8_t range_;
};

/// Where packets of a stream come from and go to.
using Way = std::function<Datagram(int number)>;

class SensorsOfOneAddress : public testing::Test {
 protected:
  /// Of each stream a packet, by turns.
  void hear(const std::vector<std::pair<Unit, Way>>& streams, int packets = kPackets) {
    for (int number = 0; number < packets; ++number) {
      for (const auto& [unit, way] : streams) {
        const auto payload = unit.packet(number);
        Datagram datagram = way(number);
        datagram.payload = payload;
        datagram.source_address = 0xC0A801C9;
        senders_.add(datagram);
      }
    }
  }
  static Way to(std::uint32_t address, std::uint16_t port, std::uint32_t vlan = 0) {
    return [=](int) {
      return Datagram{.payload = {},
                      .destination_address = address,
                      .source_port = 2368,
                      .destination_port = port,
                      .vlan = vlan};
    };
  }
  static Way from(std::uint16_t port, std::uint64_t mac = 0) {
    return [=](int) {
      return Datagram{
          .payload = {}, .source_port = port, .destination_port = 2368, .source_mac = mac};
    };
  }

  SenderStreams senders_{sensor::SensorModel::kVlp16};
};

TEST_F(SensorsOfOneAddress, AreToldApartByWhereTheySendTo) {
  const Unit in_phase(400), clock_apart(106'000'000, 2000, 2);
  for (const Unit& second : {in_phase, clock_apart}) {
    for (const auto& way : {to(1, 2369), to(2, 2368), to(1, 2368, 20)}) {
      senders_ = SenderStreams(sensor::SensorModel::kVlp16);
      hear({{Unit(), to(1, 2368)}, {second, way}});
      const auto sensors = senders_.sensors();
      ASSERT_THAT(sensors, SizeIs(2));
      EXPECT_EQ(sensors[0].packets, 100U);
      EXPECT_THAT(sensors[0].destinations, SizeIs(1));
    }
  }
}

TEST_F(SensorsOfOneAddress, AreOneWhereAPlaceGetsCopiesOfAnothers) {
  const Unit unit;
  hear({{unit, to(1, 2368)}, {unit, to(1, 2368, 20)}, {unit, to(2, 2368)}});
  const auto sensors = senders_.sensors();
  ASSERT_THAT(sensors, SizeIs(1));
  EXPECT_THAT(sensors[0].destinations, SizeIs(3));
}

TEST_F(SensorsOfOneAddress, AreTwoWhereOneOfThemIsCopied) {
  const Unit unit;
  hear({{unit, to(1, 2368)}, {unit, to(1, 2368, 20)}, {Unit(400, 0, 2), to(1, 2369)}});
  EXPECT_THAT(senders_.sensors(), SizeIs(2));
}

TEST_F(SensorsOfOneAddress, AreTwoWhereOneSaysLongAfterwardsWhatTheOtherSaid) {
  const Unit unit;
  for (int number = 200; number < 400; ++number) {
    const auto now = unit.packet(number), before = unit.packet(number - 100);
    senders_.add({.payload = now, .destination_port = 2368});
    senders_.add({.payload = before, .destination_port = 2369});
  }
  EXPECT_THAT(senders_.sensors(), SizeIs(2));
}

TEST_F(SensorsOfOneAddress, AreOneWhoseStreamIsSpreadOverSeveralPlaces) {
  hear({{Unit(), [](int number) {
           return Datagram{.payload = {},
                           .destination_port = static_cast<std::uint16_t>(2368 + number % 2)};
         }}});
  ASSERT_THAT(senders_.sensors(), SizeIs(1));
  EXPECT_THAT(senders_.sensors()[0].destinations, SizeIs(2));
}

TEST_F(SensorsOfOneAddress, AreTwoWhereOneFollowsAnotherElsewhere) {
  hear({{Unit(), to(1, 2368)}});
  hear({{Unit(5'000'000, 100, 3), to(1, 2369)}});
  EXPECT_THAT(senders_.sensors(), SizeIs(2));
}

TEST_F(SensorsOfOneAddress, AreToldApartByTheirSourcePortsIfTheirPacketsContradictEachOther) {
  for (const Unit& second : {Unit(0, 0, 2), Unit(400), Unit(660), Unit(-3'000'000, 100)}) {
    senders_ = SenderStreams(sensor::SensorModel::kVlp16);
    hear({{Unit(), from(50'000)}, {second, from(50'001)}});
    const auto sensors = senders_.sensors();
    ASSERT_THAT(sensors, SizeIs(2));
    EXPECT_EQ(sensors[0].source_port, 50'000);
    EXPECT_EQ(sensors[1].source_port, 50'001);
  }
}

TEST_F(SensorsOfOneAddress, AreToldApartByTheirLinkLayerAddressesToo) {
  hear({{Unit(), from(2368, 0xA)}, {Unit(400, 0, 2), from(2368, 0xB)}});
  const auto sensors = senders_.sensors();
  ASSERT_THAT(sensors, SizeIs(2));
  EXPECT_EQ(sensors[0].source_mac, 0xAU);
  EXPECT_EQ(sensors[0].source_port, std::nullopt);
}

TEST_F(SensorsOfOneAddress, AreOneWhoseSenderTakesAnotherPortForEachPacket) {
  hear({{Unit(), [](int number) {
           return Datagram{.payload = {},
                           .source_port = static_cast<std::uint16_t>(40'000 + number)};
         }}});
  ASSERT_THAT(senders_.sensors(), SizeIs(1));
  EXPECT_EQ(senders_.sensors()[0].source_port, std::nullopt);
}

TEST_F(SensorsOfOneAddress, AreOneWhoseSenderHasRestarted) {
  hear({{Unit(), from(50'000)}});
  hear({{Unit(-500'000, 77, 2), from(50'001)}});
  EXPECT_THAT(senders_.sensors(), SizeIs(1));
}

TEST_F(SensorsOfOneAddress, ThatNothingTellsApartAreKnownToContradictEachOther) {
  hear({{Unit(), to(1, 2368)}, {Unit(400, 0, 2), to(1, 2368)}});
  ASSERT_THAT(senders_.sensors(), SizeIs(1));
  EXPECT_TRUE(senders_.sensors()[0].contradicts_itself);
  senders_ = SenderStreams(sensor::SensorModel::kVlp16);
  hear({{Unit(), to(1, 2368)}});
  EXPECT_FALSE(senders_.sensors()[0].contradicts_itself);
}

TEST_F(SensorsOfOneAddress, WithoutAClockContradictNothing) {
  for (int number = 0; number < kPackets; ++number) {
    auto payload = Unit().packet(number);
    std::fill_n(payload.begin() + 1200, 4, std::uint8_t{0});
    senders_.add({.payload = payload, .source_port = static_cast<std::uint16_t>(number % 3)});
  }
  ASSERT_THAT(senders_.sensors(), SizeIs(1));
  EXPECT_FALSE(senders_.sensors()[0].contradicts_itself);
}

TEST_F(SensorsOfOneAddress, AreOneWhosePacketsAreOutOfOrder) {
  const Unit unit;
  for (int number = 0; number < kPackets; ++number) {
    const int late = number % 10 == 8 ? 1 : number % 10 == 9 ? -1 : 0;
    const auto payload = unit.packet(number + late);
    senders_.add({.payload = payload, .source_port = static_cast<std::uint16_t>(number % 3)});
  }
  EXPECT_THAT(senders_.sensors(), SizeIs(1));
}

TEST(SensorStream, HoldsWhatIsNoDataPacketOfAnotherStream) {
  const SensorStream stream{.model = sensor::SensorModel::kVlp16, .destinations = {{1, 2368, 0}}};
  const auto payload = Unit().packet(0);
  const std::vector<std::uint8_t> other(512);
  EXPECT_TRUE(
      stream.may_hold({.payload = payload, .destination_address = 1, .destination_port = 2368}));
  EXPECT_FALSE(
      stream.may_hold({.payload = payload, .destination_address = 1, .destination_port = 2369}));
  EXPECT_TRUE(
      stream.may_hold({.payload = other, .destination_address = 1, .destination_port = 8308}));
}

}  // namespace
}  // namespace terracut::streams
