// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/send/udp_sender.hpp"

#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>

#include "tests/firmware_io/net/restricted_thread.hpp"
#include "tests/firmware_io/net/wire.hpp"

namespace terracut::test {
namespace {

using send::UdpSender;
using send::UdpSenderConfig;
using testing::HasSubstr;

class UdpSenderTest : public LiveTest {};

TEST_F(UdpSenderTest, SendsMoreThanABatchInOrder) {
  auto source = open();
  auto sender = sender_to(source);
  Numbered numbered(3 * UdpSender::kBatch + 7, 600);
  EXPECT_EQ(sender.send(numbered.datagrams()), numbered.datagrams().size());
  const auto received = receive(source, numbered.datagrams().size());
  for (std::size_t i = 0; i < received.size(); ++i) EXPECT_EQ(received[i].number(), i);
  EXPECT_EQ(sender.counters().sent, numbered.datagrams().size());
  EXPECT_EQ(sender.counters().bytes, 600 * numbered.datagrams().size());
  EXPECT_EQ(sender.counters().failed, 0U);
}

TEST(SendCounters, OfSeveralSendersAddUp) {
  send::SendCounters sum{.sent = 1, .bytes = 20, .failed = 3, .last_error = ENOBUFS};
  sum += {.sent = 400, .bytes = 5000, .failed = 60000, .last_error = 0};
  EXPECT_EQ(sum.sent, 401U);
  EXPECT_EQ(sum.bytes, 5020U);
  EXPECT_EQ(sum.failed, 60003U);
  EXPECT_EQ(sum.last_error, ENOBUFS) << "the other had none";
  sum += {.last_error = ENETUNREACH};
  EXPECT_EQ(sum.last_error, ENETUNREACH);
}

TEST_F(UdpSenderTest, DoesNotMindThatNobodyListens) {
  // Bound, so that no other program gets the port, and connected, so that it hears nobody else.
  const files::OwnedDescriptor deaf(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const sockaddr_in any = net::socket_address({kLocalhost, 0});
  const sockaddr_in elsewhere = net::socket_address({kOtherLocalhost, 9});
  ASSERT_EQ(::bind(deaf.get(), reinterpret_cast<const sockaddr*>(&any), sizeof any), 0);
  ASSERT_EQ(::connect(deaf.get(), reinterpret_cast<const sockaddr*>(&elsewhere), sizeof any), 0);
  sockaddr_in local{};
  socklen_t size = sizeof local;
  ::getsockname(deaf.get(), reinterpret_cast<sockaddr*>(&local), &size);
  auto sender = UdpSender::open({.to = net::endpoint_of(local)}, memory_);
  ASSERT_TRUE(sender);
  Numbered numbered(10);
  EXPECT_EQ(sender->send(numbered.datagrams()), 10U);
  EXPECT_EQ(sender->send(numbered.datagrams()), 10U);
  EXPECT_EQ(sender->counters().failed, 0U);
}

TEST_F(UdpSenderTest, CountsWhatTheSystemRefusesAndSendsTheRest) {
  auto source = open();
  auto sender = sender_to(source);
  Numbered small(4), too_large(1, 70'000);
  std::vector<packet::Datagram> mixed = small.datagrams();
  mixed.insert(mixed.begin() + 2, too_large.datagrams().front());
  EXPECT_EQ(sender.send(mixed), 4U);
  EXPECT_EQ(sender.counters().sent, 4U);
  EXPECT_EQ(sender.counters().failed, 1U);
  EXPECT_EQ(sender.counters().last_error, EMSGSIZE);
  EXPECT_EQ(numbers_of(receive(source, 4)), (std::vector<std::uint64_t>{0, 1, 2, 3}));
}

TEST_F(UdpSenderTest, RefusesWhatIsNoDestinationOrNoSource) {
  const auto expect_refusal = [&](const UdpSenderConfig& config, ErrorCode code,
                                  const std::string& message) {
    const auto sender = UdpSender::open(config, memory_);
    ASSERT_FALSE(sender);
    EXPECT_EQ(sender.error().code, code);
    EXPECT_THAT(sender.error().message, HasSubstr(message));
  };
  expect_refusal({.to = {0, 2368}}, ErrorCode::kInvalidArgument, "0.0.0.0:2368");
  expect_refusal({.to = {kLocalhost, 0}}, ErrorCode::kInvalidArgument, "127.0.0.1:0");
  expect_refusal({.to = {kLocalhost, 1}, .interface = "nosuch0"}, ErrorCode::kNotFound, "nosuch0");
  const auto source = open({.bind = {kLocalhost, 0}});
  expect_refusal({.to = {kLocalhost, 1}, .from = source.local()}, ErrorCode::kUnreadable,
                 "127.0.0.1:" + std::to_string(source.local().port));
  EXPECT_GT(memory_.total_bytes(), 0U);
}

TEST_F(UdpSenderTest, CountsFailuresWhereThereIsNoRoute) {
  const bool made = PrivateNetwork::run([&](PrivateNetwork&) {
    auto sender = UdpSender::open({.to = {0x0A4D0001, 2368}}, memory_);
    ASSERT_TRUE(sender);
    Numbered numbered(3);
    EXPECT_EQ(sender->send(numbered.datagrams()), 0U);
    EXPECT_EQ(sender->counters().failed, 3U);
    EXPECT_EQ(sender->counters().last_error, ENETUNREACH);
  });
  if (!made) GTEST_SKIP() << "not permitted to make a network";
}

}  // namespace
}  // namespace terracut::test
