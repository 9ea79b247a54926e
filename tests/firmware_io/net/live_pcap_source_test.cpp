// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/live_pcap_source.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "restricted_thread.hpp"
#include "wire.hpp"

namespace terracut::test {
namespace {

using net::LivePcapConfig;
using net::LivePcapSource;
using testing::AllOf;
using testing::HasSubstr;

/// Listens on the loopback interface beside a socket that holds the port.
class LivePcapSourceTest : public LiveTest {
 protected:
  void SetUp() override {
    const auto tried = LivePcapSource::open({.interface = "lo"}, memory_);
    if (!tried) GTEST_SKIP() << tried.error().message;
  }
  [[nodiscard]] LivePcapSource listen(LivePcapConfig config = {}) {
    config.interface = "lo";
    config.port = socket_.local().port;
    auto source = LivePcapSource::open(std::move(config), memory_);
    if (!source) throw std::runtime_error(source.error().message);
    return *std::move(source);
  }

  net::UdpSource socket_ = open();
};

TEST_F(LivePcapSourceTest, HearsWhatASocketHears) {
  auto source = listen();
  auto sender = sender_to(socket_, kOtherLocalhost);
  Numbered numbered(150);
  sender.send(numbered.datagrams());
  const auto heard = receive(source, 150);
  const auto received = receive(socket_, 150);
  ASSERT_EQ(heard.size(), 150U);
  for (std::size_t i = 0; i < heard.size(); ++i) {
    EXPECT_EQ(heard[i].bytes, received[i].bytes);
    EXPECT_EQ(heard[i].datagram.source_address, kOtherLocalhost);
    EXPECT_EQ(heard[i].datagram.source_port, received[i].datagram.source_port);
    EXPECT_EQ(heard[i].datagram.destination_address, kLocalhost);
    EXPECT_EQ(heard[i].datagram.destination_port, socket_.local().port);
    // Both stamps are of the same moment; a minute of doubt lets the clock be set meanwhile.
    EXPECT_NEAR(static_cast<double>(heard[i].datagram.stamp_ns - received[i].datagram.stamp_ns), 0,
                60e9);
  }
  EXPECT_EQ(source.counters().delivered, 150U);
}

TEST_F(LivePcapSourceTest, LeavesOtherPortsAndOtherSendersOut) {
  auto source = listen({.sender = net::Sender{kLocalhost}});
  auto other_port = open();
  auto elsewhere = sender_to(other_port);
  auto stranger = sender_to(socket_, kOtherLocalhost);
  auto sensor = sender_to(socket_);
  Numbered unwanted(5, 600, 100), wanted(3, 600);
  elsewhere.send(unwanted.datagrams());
  stranger.send(unwanted.datagrams());
  sensor.send(wanted.datagrams());
  EXPECT_EQ(numbers_of(receive(source, 3)), (std::vector<std::uint64_t>{0, 1, 2}));
  EXPECT_EQ(source.counters().foreign, 5U);
  EXPECT_EQ(source.counters().received, 8U);
}

TEST_F(LivePcapSourceTest, CountsDatagramsLongerThanASlot) {
  auto source = listen({.slot_bytes = 100});
  auto sender = sender_to(socket_);
  Numbered longer(2, 101), much_longer(2, 2000), fitting(1, 100);
  sender.send(longer.datagrams());
  sender.send(much_longer.datagrams());
  sender.send(fitting.datagrams());
  EXPECT_EQ(receive(source, 1).size(), 1U);
  EXPECT_EQ(source.counters().truncated + source.counters().no_datagram, 4U);
  EXPECT_GE(source.counters().truncated, 2U);
}

TEST_F(LivePcapSourceTest, ReturnsEmptyWhenNothingComesOrSomebodyWakesIt) {
  auto source = listen();
  EXPECT_TRUE(source.receive(0).empty());
  EXPECT_TRUE(source.receive(5 * kMillisecond_ns).empty());
  std::thread waker([&] { source.wake(); });
  EXPECT_TRUE(source.receive(INT64_MAX).empty());
  waker.join();
}

TEST_F(LivePcapSourceTest, ReturnsAtMostABatchAtATime) {
  auto source = listen({.batch = 4});
  auto sender = sender_to(socket_);
  Numbered numbered(10);
  sender.send(numbered.datagrams());
  std::size_t count = 0;
  while (count < 10) {
    const auto batch = source.receive(kPatience_ns);
    ASSERT_FALSE(batch.empty());
    EXPECT_LE(batch.size(), 4U);
    count += batch.size();
  }
}

class LivePcapRefusal : public LiveTest {};

TEST_F(LivePcapRefusal, OfAProcessWithoutTheRightNamesTheCapability) {
  as_nobody([&] {
    const auto source = LivePcapSource::open({.interface = "lo"}, memory_);
    ASSERT_FALSE(source);
    EXPECT_EQ(source.error().code, ErrorCode::kUnreadable);
    EXPECT_THAT(source.error().message, AllOf(HasSubstr("'lo'"), HasSubstr("CAP_NET_RAW")));
  });
}

TEST_F(LivePcapRefusal, OfAnUnknownInterfaceListsThoseThereAre) {
  const auto source = LivePcapSource::open({.interface = "nosuch0"}, memory_);
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(source.error().message, AllOf(HasSubstr("'nosuch0'"), HasSubstr("lo")));
}

}  // namespace
}  // namespace terracut::test
