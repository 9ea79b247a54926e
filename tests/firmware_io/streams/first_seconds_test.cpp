// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/streams/first_seconds.hpp"

#include <gmock/gmock.h>

#include <span>
#include <vector>

#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "tests/firmware_io/hdl64e/random_drive.hpp"

namespace terracut::streams {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::uint32_t kSensorAddress = 0xC0A801C9, kOtherAddress = 0xC0A80107;
constexpr double kFrames_hz = 10;

/// Packets of a head that rotates ten times a second.
std::vector<test::Packet> seconds(double duration_s) {
  return test::random_packets(
      {.first_cdeg = 0,
       .last_cdeg = static_cast<std::int64_t>(duration_s * kFrames_hz * 36'000),
       .share_of_returns = 0.01});
}

FirstSeconds::Config anything() {
  FirstSeconds::Config config;
  config.place = "0.0.0.0:2368";
  config.device_port = 7788;
  return config;
}
FirstSeconds::Config with_table() {
  FirstSeconds::Config config = anything();
  config.calibration.unit = hdl64e::nominal_hdl64e();
  return config;
}

void hear(FirstSeconds& first, std::span<const test::Packet> packets,
          std::uint32_t from = kSensorAddress) {
  for (const test::Packet& packet : packets) {
    packet::Datagram datagram = packet.datagram();
    datagram.source_address = from;
    first.add(datagram);
  }
}

TEST(FirstSeconds, SayWhatIsWaitedForAsLongAsNothingCame) {
  const FirstSeconds first(anything());
  EXPECT_FALSE(first.is_enough());
  EXPECT_EQ(first.waits_for(),
            "waiting for a Velodyne, RoboSense, Hesai or Ouster at 0.0.0.0:2368");
}

TEST(FirstSeconds, AreEnoughWhenASensorRotatesThatNobodyElseSendsBeside) {
  FirstSeconds first(with_table());
  const auto packets = seconds(1);
  hear(first, std::span(packets).first(600));
  EXPECT_FALSE(first.is_enough()) << "another sensor would show within 0.3 s";
  hear(first, std::span(packets).subspan(600));
  EXPECT_TRUE(first.is_enough());
  const auto found = first.conclude();
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->sender.address, kSensorAddress);
  EXPECT_EQ(found->model, sensor::SensorModel::kHdl64e);
  EXPECT_NEAR(found->spin_hz, kFrames_hz, 0.2);
  EXPECT_EQ(calib::fingerprint(found->calibration), hdl64e::fingerprint(hdl64e::nominal_hdl64e()));
}

TEST(FirstSeconds, WaitForTheTableOfASensorSixSecondsAndNoLonger) {
  FirstSeconds first(anything());
  const auto packets = seconds(7);
  const auto after = [&](double time_s) {
    return std::span(packets).first(
        static_cast<std::size_t>(time_s / 7 * static_cast<double>(packets.size())));
  };
  hear(first, after(5));
  EXPECT_FALSE(first.is_enough());
  EXPECT_THAT(first.waits_for(),
              AllOf(HasSubstr("192.168.1.201"), HasSubstr("waiting for its calibration")));
  hear(first, std::span(packets).subspan(after(5).size()));
  EXPECT_TRUE(first.is_enough());
  const auto found = first.conclude();
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kNoCalibration);
  EXPECT_THAT(found.error().message, HasSubstr("--calibration FILE"));
}

TEST(FirstSeconds, OneStrayPacketOfAnotherSenderRefusesNothing) {
  FirstSeconds first(with_table());
  const auto packets = seconds(1);
  hear(first, std::span(packets).first(1), kOtherAddress);
  hear(first, packets);
  EXPECT_TRUE(first.is_enough());
  ASSERT_TRUE(first.conclude());
  EXPECT_EQ(first.conclude()->sender.address, kSensorAddress);
}

TEST(FirstSeconds, SeveralSensorsAreNamedAndNoneIsChosen) {
  FirstSeconds first(with_table());
  const auto packets = seconds(1);
  hear(first, packets);
  hear(first, packets, kOtherAddress);
  const auto found = first.conclude();
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(found.error().message,
              AllOf(HasSubstr("192.168.1.201"), HasSubstr("192.168.1.7"), HasSubstr("--from")));
}

TEST(FirstSeconds, OfSeveralSensorsTheOneThatWasInUseBeforeIsTaken) {
  FirstSeconds::Config config = with_table();
  config.known = net::Sender{kSensorAddress};
  FirstSeconds first(config);
  const auto packets = seconds(1);
  hear(first, packets, kOtherAddress);
  hear(first, packets);
  EXPECT_TRUE(first.is_enough());
  const auto found = first.conclude();
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->sender.address, kSensorAddress);
  EXPECT_THAT(first.other_sensors(),
              AllOf(HasSubstr("192.168.1.7"), testing::Not(HasSubstr("192.168.1.201"))));
}

TEST(FirstSeconds, OfTwoSensorsBehindOneAddressNameThePortsTheySendFrom) {
  constexpr std::size_t kAhead = 500;
  const auto packets = seconds(1);
  const auto heard_by = [&](FirstSeconds& first) {
    for (std::size_t n = 0; n + kAhead < packets.size(); ++n) {
      for (const std::uint16_t port : {std::uint16_t{50'001}, std::uint16_t{50'002}}) {
        packet::Datagram datagram = packets[port == 50'001 ? n : n + kAhead].datagram();
        datagram.stamp_ns = packets[n].stamp_ns;
        datagram.source_address = kSensorAddress;
        datagram.source_port = port;
        first.add(datagram);
      }
    }
  };
  FirstSeconds first(with_table());
  heard_by(first);
  EXPECT_TRUE(first.is_enough());
  const auto found = first.conclude();
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().message,
              HasSubstr("choose one with --from 192.168.1.201:50001 or --from "
                        "192.168.1.201:50002"));

  FirstSeconds::Config config = with_table();
  config.known = net::Sender{kSensorAddress, 50'002};
  FirstSeconds again(config);
  heard_by(again);
  ASSERT_TRUE(again.conclude());
  EXPECT_EQ(again.conclude()->sender, (net::Sender{kSensorAddress, 50'002}));
  EXPECT_THAT(again.other_sensors(), HasSubstr("192.168.1.201 from port 50001"));
}

TEST(FirstSeconds, TheOneThatWasInUseBeforeIsWaitedForUntilItsHeadRotates) {
  FirstSeconds::Config config = with_table();
  config.known = net::Sender{kSensorAddress};
  FirstSeconds first(config);
  const auto packets = seconds(1);
  std::vector<test::Packet> standing(100, packets.front());
  hear(first, standing);
  hear(first, packets, kOtherAddress);
  EXPECT_FALSE(first.is_enough());
  EXPECT_THAT(first.waits_for(), HasSubstr("whose head does not rotate, from 192.168.1.201"));
  hear(first, packets);
  EXPECT_TRUE(first.is_enough());
  ASSERT_TRUE(first.conclude());
  EXPECT_EQ(first.conclude()->sender.address, kSensorAddress);
}

TEST(FirstSeconds, AnotherSensorIsTakenWhereTheOneBeforeDoesNotSend) {
  FirstSeconds::Config config = with_table();
  config.known = net::Sender{kSensorAddress};
  FirstSeconds first(config);
  hear(first, seconds(1), kOtherAddress);
  EXPECT_TRUE(first.is_enough());
  ASSERT_TRUE(first.conclude());
  EXPECT_EQ(first.conclude()->sender.address, kOtherAddress);
  EXPECT_EQ(first.other_sensors(), "");
}

TEST(FirstSeconds, SeveralSensorsEndTheWaitForACalibration) {
  FirstSeconds first(anything());
  const auto packets = seconds(1);
  hear(first, packets);
  EXPECT_FALSE(first.is_enough()) << "one sensor may still tell its calibration";
  hear(first, packets, kOtherAddress);
  EXPECT_TRUE(first.is_enough()) << "no calibration makes it one sensor";
}

TEST(FirstSeconds, AHeadThatDoesNotRotateIsTakenWhenThePatienceEnds) {
  FirstSeconds first(with_table());
  const auto rotating = seconds(1);
  std::vector<test::Packet> standing(rotating.size(), rotating.front());
  for (std::size_t n = 0; n < standing.size(); ++n) standing[n].stamp_ns = rotating[n].stamp_ns;
  hear(first, standing);
  EXPECT_FALSE(first.is_enough());
  const auto found = first.conclude();
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->sender.address, kSensorAddress);
  EXPECT_EQ(found->spin_hz, 0);
}

TEST(FirstSeconds, TakeTheColumnsAskedForBeforeThoseOfTheSpinRate) {
  const auto packets = seconds(1);
  FirstSeconds by_rate(with_table());
  hear(by_rate, packets);
  ASSERT_TRUE(by_rate.conclude());
  FirstSeconds::Config config = with_table();
  config.columns = by_rate.conclude()->columns / 2;
  FirstSeconds asked(config);
  hear(asked, packets);
  ASSERT_TRUE(asked.conclude());
  EXPECT_EQ(asked.conclude()->columns, config.columns);
}

TEST(FirstSeconds, NameWhatCameInsteadOfASensor) {
  FirstSeconds first(anything());
  const std::vector<std::uint8_t> noise(100);
  first.add({.payload = noise, .stamp_ns = 1, .source_address = kOtherAddress});
  const auto found = first.conclude(2.5);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(found.error().message, AllOf(HasSubstr("within 2.5 s"), HasSubstr("192.168.1.7")));
}

TEST(FirstSeconds, SayThatOthersSendWhereOneSenderIsWanted) {
  FirstSeconds first(anything());
  first.note_foreign(12);
  EXPECT_THAT(first.waits_for(), HasSubstr("12 datagrams from other addresses than --from"));
}

TEST(FirstSeconds, AskForTheDevicePortOnlyWhereItMayTellACalibrationThatIsMissing) {
  EXPECT_TRUE(FirstSeconds(anything()).wants_device_port());
  EXPECT_FALSE(FirstSeconds(with_table()).wants_device_port());
  FirstSeconds::Config only_hdl64e = anything();
  only_hdl64e.model = sensor::SensorModel::kHdl64e;
  EXPECT_FALSE(FirstSeconds(only_hdl64e).wants_device_port());
  FirstSeconds::Config no_port = anything();
  no_port.device_port = 0;
  EXPECT_FALSE(FirstSeconds(no_port).wants_device_port());
}

}  // namespace
}  // namespace terracut::streams
