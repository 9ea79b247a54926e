// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What the live sources do when the cable is pulled.

#include "firmware_io/net/live_pcap_source.hpp"
#include "restricted_thread.hpp"
#include "wire.hpp"

namespace terracut::test {
namespace {

using net::LinkState;
using net::LivePcapSource;
using net::UdpSource;
using send::UdpSender;

constexpr std::uint32_t kHere = 0x0A4D0001;  // 10.77.0.1
constexpr std::uint32_t kLossGroup = 0xEF4D0001;
constexpr std::uint16_t kPort = 2368;

class InterfaceLoss : public LiveTest {
 protected:
  /// Pulls and puts back the cable in every way, with such a source and a sensor on the
  /// other machine that sends to `to`.
  template <class Source = UdpSource, class Config = net::UdpSourceConfig>
  void survive(std::uint32_t to, const Config& config) {
    with_cable([&](PrivateNetwork& network) { survive<Source>(network, to, config); });
  }
  template <class Source>
  void survive(PrivateNetwork& network, std::uint32_t to, const auto& config) {
    const bool names_interface = !config.interface.empty();
    auto source = Source::open(config, memory_);
    ASSERT_TRUE(source) << source.error().message;
    expect_reception(network, *source, to);

    ASSERT_TRUE(network.ip("link set sensor0 down"));
    if (names_interface) wait_for(*source, LinkState::kDown);
    EXPECT_TRUE(source->receive(kMillisecond_ns).empty());
    ASSERT_TRUE(network.ip("link set sensor0 up"));
    ASSERT_TRUE(add_route(network));
    expect_reception(network, *source, to);

    ASSERT_TRUE(network.ip("link del sensor0"));
    if (names_interface) wait_for(*source, LinkState::kGone);
    EXPECT_TRUE(source->receive(kMillisecond_ns).empty());
    ASSERT_TRUE(network.plug_in());
    ASSERT_TRUE(add_route(network));
    expect_reception(network, *source, to);
    if (!names_interface) return;
    EXPECT_EQ(source->link(), LinkState::kUp);
    EXPECT_EQ(source->counters().link_losses, 2U);
    EXPECT_EQ(source->counters().reopened, 1U);
  }
  /// Sends until something comes: after an outage, neighbours have to find each other again.
  template <class Source>
  void expect_reception(PrivateNetwork& network, Source& source, std::uint32_t to) {
    auto sensor = network.on_the_other(
        [&] { return UdpSender::open({.to = {to, kPort}, .interface = "wire0"}, memory_); });
    ASSERT_TRUE(sensor) << sensor.error().message;
    Numbered numbered(1);
    std::vector<Received> received;
    EXPECT_TRUE(receive_until(source, received, [&] {
      if (received.empty()) sensor->send(numbered.datagrams());
      return !received.empty();
    }));
  }
  /// Sends more than the smallest buffer holds; each is received or counted as dropped.
  void flood(PrivateNetwork& network, UdpSource& source) {
    constexpr std::uint64_t kSent = 300;
    auto sensor = network.on_the_other(
        [&] { return UdpSender::open({.to = {kHere, kPort}, .interface = "wire0"}, memory_); });
    ASSERT_TRUE(sensor) << sensor.error().message;
    source.refresh_drops();
    const auto& counters = source.counters();
    const std::uint64_t dropped_before = counters.kernel_drops;
    const std::uint64_t before = counters.received + counters.kernel_drops;
    Numbered numbered(kSent);
    EXPECT_EQ(sensor->send(numbered.datagrams()), kSent);
    std::vector<Received> received;
    EXPECT_TRUE(receive_until(source, received, [&] {
      source.refresh_drops();
      return counters.received + counters.kernel_drops >= before + kSent;
    }));
    EXPECT_GT(counters.kernel_drops - dropped_before, kSent / 2);
    EXPECT_LE(counters.kernel_drops - dropped_before, kSent);
  }
  template <class Source>
  static void wait_for(Source& source, LinkState state) {
    std::vector<Received> received;
    EXPECT_TRUE(receive_until(source, received, [&] { return source.link() == state; }));
  }
  static bool add_route(PrivateNetwork& network) {
    return network.ip("route replace 224.0.0.0/4 dev sensor0");
  }
  /// Runs `body` with a cable plugged in; skips where that cannot be had.
  template <class Body>
  void with_cable(Body&& body) {
    bool plugged = false;
    const bool made = PrivateNetwork::run([&](PrivateNetwork& network) {
      plugged = network.plug_in() && add_route(network);
      if (plugged) body(network);
    });
    if (!made || !plugged) GTEST_SKIP() << "not permitted to make a network, or no program ip";
  }
};

TEST_F(InterfaceLoss, IsSurvivedByASourceOnThatInterface) {
  survive(kHere, {.bind = {0, kPort}, .interface = "sensor0"});
}

TEST_F(InterfaceLoss, IsSurvivedByASourceBoundToItsAddress) {
  survive(kHere, {.bind = {kHere, kPort}});
}

TEST_F(InterfaceLoss, IsSurvivedByAMulticastGroupOnThatInterface) {
  survive(kLossGroup, {.bind = {0, kPort}, .multicast_group = kLossGroup, .interface = "sensor0"});
}

TEST_F(InterfaceLoss, IsSurvivedByAMulticastGroupThatTheRoutesLeadTo) {
  survive(kLossGroup, {.bind = {0, kPort}, .multicast_group = kLossGroup});
}

TEST_F(InterfaceLoss, IsSurvivedByListeningWithLibpcap) {
  survive<LivePcapSource, net::LivePcapConfig>(kHere, {.interface = "sensor0", .port = kPort});
}

TEST_F(InterfaceLoss, LosesNoCountOfDropsAndInventsNone) {
  with_cable([&](PrivateNetwork& network) {
    auto source = open({.bind = {0, kPort}, .interface = "sensor0", .receive_buffer_bytes = 1});
    expect_reception(network, source, kHere);
    flood(network, source);
    ASSERT_TRUE(network.ip("link del sensor0"));
    wait_for(source, LinkState::kGone);
    ASSERT_TRUE(network.plug_in());
    expect_reception(network, source, kHere);
    flood(network, source);
  });
}

TEST_F(InterfaceLoss, DoesNotKeepBroadcastsFromASourceOnThatInterface) {
  with_cable([&](PrivateNetwork& network) {
    auto source = open({.bind = {0, kPort}, .interface = "sensor0"});
    expect_reception(network, source, 0x0A4D00FF);  // 10.77.0.255
    expect_reception(network, source, 0xFFFFFFFF);
  });
}

}  // namespace
}  // namespace terracut::test
