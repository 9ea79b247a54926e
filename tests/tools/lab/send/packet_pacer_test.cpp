// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/send/packet_pacer.hpp"

#include <thread>

#include "tests/firmware_io/net/wire.hpp"

namespace terracut::test {
namespace {

using send::PacketPacer;

class PacketPacerTest : public LiveTest {
 protected:
  /// Plays datagrams stamped `step_ns` apart and returns how long that took.
  std::int64_t play(PacketPacer& pacer, Numbered& numbered, std::int64_t step_ns) {
    const std::int64_t begun_ns = measure::monotonic_ns();
    std::int64_t stamp_ns = 1'700'000'000'000'000'000;
    for (auto& each : numbered.datagrams()) {
      each.stamp_ns = stamp_ns;
      stamp_ns += step_ns;
      pacer.add(each, sender_);
    }
    pacer.flush();
    return measure::monotonic_ns() - begun_ns;
  }
  void expect_all_came(std::size_t count) {
    const auto received = receive(source_, count);
    for (std::size_t i = 0; i < received.size(); ++i) EXPECT_EQ(received[i].number(), i);
  }

  net::UdpSource source_ = open();
  send::UdpSender sender_ = sender_to(source_);
};

TEST_F(PacketPacerTest, SendsNothingBeforeItsTime) {
  PacketPacer pacer(1, memory_);
  Numbered numbered(6);
  EXPECT_GE(play(pacer, numbered, 10 * kMillisecond_ns), 50 * kMillisecond_ns);
  expect_all_came(6);
  EXPECT_EQ(pacer.lateness().count(), 6U);
}

TEST_F(PacketPacerTest, TakesTwiceAsLongAtHalfTheRate) {
  PacketPacer pacer(0.5, memory_);
  Numbered numbered(4);
  EXPECT_GE(play(pacer, numbered, 50 * kMillisecond_ns), 300 * kMillisecond_ns);
  expect_all_came(4);
}

TEST_F(PacketPacerTest, BeginsAfterTheDelayItWasGiven) {
  PacketPacer pacer(1, memory_, 30 * kMillisecond_ns);
  Numbered numbered(1);
  EXPECT_GE(play(pacer, numbered, 0), 30 * kMillisecond_ns);
}

TEST_F(PacketPacerTest, SendsAsFastAsItCanAtRateNull) {
  PacketPacer pacer(0, memory_);
  Numbered numbered(300, 100);
  play(pacer, numbered, std::int64_t{3600} * 1000 * kMillisecond_ns);
  expect_all_came(300);
  EXPECT_EQ(pacer.lateness().count(), 0U);
}

TEST_F(PacketPacerTest, SendsAllOfOneStampHoweverManyTheyAre) {
  PacketPacer pacer(1, memory_);
  Numbered numbered(150);
  play(pacer, numbered, 0);
  expect_all_came(150);
}

TEST_F(PacketPacerTest, TakesStampsThatGoBackAsDueAtOnce) {
  PacketPacer pacer(1, memory_);
  Numbered numbered(3);
  play(pacer, numbered, -std::int64_t{3600} * 1000 * kMillisecond_ns);
  expect_all_came(3);
}

TEST_F(PacketPacerTest, SendsThroughTheSenderEachDatagramWasGivenTo) {
  auto other = sender_to(source_, kOtherLocalhost);
  PacketPacer pacer(1, memory_);
  Numbered numbered(4);
  for (std::size_t i = 0; i < 4; ++i) pacer.add(numbered.datagrams()[i], i == 2 ? other : sender_);
  pacer.flush();
  const auto received = receive(source_, 4);
  for (std::size_t i = 0; i < received.size(); ++i) {
    EXPECT_EQ(received[i].number(), i);
    EXPECT_EQ(received[i].datagram.source_address, i == 2 ? kOtherLocalhost : kLocalhost);
  }
}

TEST_F(PacketPacerTest, CopiesWhatItIsGiven) {
  PacketPacer pacer(1, memory_);
  std::vector<std::uint8_t> payload(8, 1);
  pacer.add({.payload = payload}, sender_);
  payload.assign(8, 2);
  pacer.flush();
  EXPECT_EQ(receive(source_, 1).at(0).bytes, std::vector<std::uint8_t>(8, 1));
}

TEST_F(PacketPacerTest, StopsWhileItWaits) {
  PacketPacer pacer(1, memory_);
  Numbered numbered(2);
  std::thread stopper([&] {
    expect_all_came(1);  // the first one is due at once, the second in an hour
    pacer.stop();
  });
  play(pacer, numbered, std::int64_t{3600} * 1000 * kMillisecond_ns);
  stopper.join();
  EXPECT_TRUE(pacer.stopped());
  EXPECT_EQ(sender_.counters().sent, 1U);
}

}  // namespace
}  // namespace terracut::test
