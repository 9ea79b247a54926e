// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What UdpSource says of settings it cannot have, wholly or in part.
#include <gmock/gmock.h>

#include <fstream>

#include "restricted_thread.hpp"
#include "wire.hpp"

namespace terracut::test {
namespace {

using net::UdpSource;
using net::UdpSourceConfig;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class UdpSourceRefusal : public LiveTest {
 protected:
  template <class Message>
  void expect_refusal(const UdpSourceConfig& config, ErrorCode code, const Message& message) {
    const auto source = UdpSource::open(config, memory_);
    ASSERT_FALSE(source);
    EXPECT_EQ(source.error().code, code) << source.error().message;
    EXPECT_THAT(source.error().message, message);
  }
};

TEST_F(UdpSourceRefusal, OfAPortInUseSaysHowToFindTheProcessAndWhatMendsIt) {
  auto first = open();
  const std::string port = std::to_string(first.local().port);
  expect_refusal({.bind = {0, first.local().port}}, ErrorCode::kUnreadable,
                 AllOf(HasSubstr("port " + port + " is in use"), HasSubstr("sport = :" + port),
                       HasSubstr("share_port")));
  expect_refusal({.bind = {0, first.local().port}, .share_port = true}, ErrorCode::kUnreadable,
                 HasSubstr("both"));
}

TEST_F(UdpSourceRefusal, OfAnUnknownInterfaceListsThoseThereAre) {
  expect_refusal({.interface = "nosuch0"}, ErrorCode::kNotFound,
                 AllOf(HasSubstr("'nosuch0'"), HasSubstr("lo")));
  expect_refusal({.interface = "a name much too long for one"}, ErrorCode::kNotFound,
                 HasSubstr("a name much too long for one"));
}

TEST_F(UdpSourceRefusal, OfAnAddressThatIsNotLocalSaysSo) {
  std::ifstream setting("/proc/sys/net/ipv4/ip_nonlocal_bind");
  if (setting.get() == '1') GTEST_SKIP() << "net.ipv4.ip_nonlocal_bind lets any address be bound";
  expect_refusal({.bind = {0xCB007107, 0}}, ErrorCode::kNotFound,
                 AllOf(HasSubstr("203.0.113.7"), HasSubstr("ip -4 addr")));
}

TEST_F(UdpSourceRefusal, OfAPrivilegedPortNamesTheCapability) {
  std::ifstream setting("/proc/sys/net/ipv4/ip_unprivileged_port_start");
  int first = 0;
  if (!(setting >> first) || first < 2) GTEST_SKIP() << "any port is allowed here";
  as_nobody([&] {
    expect_refusal({.bind = {kLocalhost, 1}}, ErrorCode::kUnreadable,
                   HasSubstr("CAP_NET_BIND_SERVICE"));
  });
}

TEST_F(UdpSourceRefusal, OfSettingsOutOfRangeNamesTheRange) {
  expect_refusal({.multicast_group = 0xC0A80001}, ErrorCode::kInvalidArgument,
                 AllOf(HasSubstr("192.168.0.1"), HasSubstr("224.0.0.0")));
  expect_refusal({.bind = {0xEF000001, 0}}, ErrorCode::kInvalidArgument,
                 HasSubstr("multicast_group"));
}

TEST_F(UdpSourceRefusal, OfAGroupWithoutAWayToItNamesTheRoute) {
  const bool made = PrivateNetwork::run([&](PrivateNetwork&) {
    expect_refusal({.multicast_group = 0xEF4D0001}, ErrorCode::kUnreadable,
                   AllOf(HasSubstr("239.77.0.1"), HasSubstr("ip route")));
  });
  if (!made) GTEST_SKIP() << "not permitted to make a network";
}

TEST_F(UdpSourceRefusal, TakesNothingFromTheLedger) {
  expect_refusal({.interface = "nosuch0"}, ErrorCode::kNotFound, HasSubstr("nosuch0"));
  EXPECT_EQ(memory_.total_bytes(), 0U);
}

TEST_F(UdpSourceRefusal, OfALargeReceiveBufferNamesTheSettingThatMendsIt) {
  std::size_t limit = 0;
  std::ifstream("/proc/sys/net/core/rmem_max") >> limit;
  if (limit == 0 || limit > 500U << 20) GTEST_SKIP() << "rmem_max is not known or has no end";
  as_nobody([&] {
    const auto source = UdpSource::open({.receive_buffer_bytes = 2 * limit}, memory_);
    ASSERT_TRUE(source);
    EXPECT_THAT(source->warnings(),
                Contains(AllOf(HasSubstr(std::to_string(limit) + " of the "),
                               HasSubstr("net.core.rmem_max=" + std::to_string(2 * limit)))));
  });
}

TEST_F(UdpSourceRefusal, DoesNotBefallAReceiveBufferWithinTheLimit) {
  as_nobody([&] {
    const auto source = open({.receive_buffer_bytes = 64U << 10});
    EXPECT_THAT(source.warnings(), IsEmpty());
  });
}

TEST_F(UdpSourceRefusal, ToBindToAnInterfaceStillLeavesOutWhatComesInElsewhere) {
  const bool filtered = without_socket_option(SO_BINDTODEVICE, EPERM, [&] {
    auto source = open({.interface = "lo", .receive_buffer_bytes = 64U << 10});
    EXPECT_THAT(source.warnings(), Contains(HasSubstr("CAP_NET_RAW")));
    auto sender = sender_to(source);
    Numbered numbered(5);
    sender.send(numbered.datagrams());
    EXPECT_EQ(receive(source, 5).size(), 5U);
    EXPECT_EQ(source.counters().other_interface, 0U);
  });
  if (!filtered) GTEST_SKIP() << "no system call filters here";
}

TEST_F(UdpSourceRefusal, ToBindToAnInterfaceCountsWhatComesInElsewhere) {
  bool plugged = false, filtered = false;
  const bool made = PrivateNetwork::run([&](PrivateNetwork& network) {
    plugged = network.plug_in();
    if (!plugged) return;
    filtered = without_socket_option(SO_BINDTODEVICE, EPERM, [&] {
      auto source = open({.interface = "sensor0"});
      auto sender = sender_to(source);  // by way of lo
      Numbered numbered(5);
      sender.send(numbered.datagrams());
      std::vector<Received> received;
      EXPECT_TRUE(receive_until(source, received, [&] { return source.counters().received == 5; }));
      EXPECT_TRUE(received.empty());
      EXPECT_EQ(source.counters().other_interface, 5U);
    });
  });
  if (!made || !plugged || !filtered) GTEST_SKIP() << "not permitted to make a network or filter";
}

}  // namespace
}  // namespace terracut::test
