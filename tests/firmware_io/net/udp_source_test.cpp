// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/udp_source.hpp"

#include <linux/sock_diag.h>

#include <csignal>
#include <ctime>
#include <numeric>
#include <thread>

#include "restricted_thread.hpp"
#include "wire.hpp"

namespace terracut::test {
namespace {

using net::UdpSource;
using net::UdpSourceConfig;
using send::UdpSender;

class UdpSourceTest : public LiveTest {};

std::int64_t utc_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

TEST_F(UdpSourceTest, DeliversDatagramsInOrderWithWhereTheyCameFromAndWhen) {
  auto source = open();
  auto sender = make_sender(
      {.to = {kLocalhost, source.local().port}, .from = net::Ipv4Endpoint{kOtherLocalhost, 0}});
  Numbered numbered(100);
  const std::int64_t before_ns = utc_ns();
  EXPECT_EQ(sender.send(numbered.datagrams()), 100U);
  const auto received = receive(source, 100);
  const std::int64_t after_ns = utc_ns();

  ASSERT_EQ(received.size(), 100U);
  const std::int64_t clock_may_be_set_ns = 60'000 * kMillisecond_ns;
  for (std::size_t i = 0; i < received.size(); ++i) {
    const Received& each = received[i];
    EXPECT_EQ(each.number(), i);
    EXPECT_EQ(each.bytes.size(), 1206U);
    EXPECT_EQ(each.datagram.source_address, kOtherLocalhost);
    EXPECT_NE(each.datagram.source_port, 0);
    EXPECT_EQ(each.datagram.source_port, received.front().datagram.source_port);
    EXPECT_EQ(each.datagram.destination_address, kLocalhost);
    EXPECT_EQ(each.datagram.destination_port, source.local().port);
    EXPECT_GE(each.datagram.stamp_ns, before_ns - clock_may_be_set_ns);
    EXPECT_LE(each.datagram.stamp_ns, after_ns + clock_may_be_set_ns);
  }
  const auto& counters = source.counters();
  EXPECT_EQ(counters.received, 100U);
  EXPECT_EQ(counters.delivered, 100U);
  EXPECT_EQ(counters.kernel_drops, 0U);
  EXPECT_EQ(counters.unstamped, 0U);
}

TEST_F(UdpSourceTest, StampsWhenTheKernelGotADatagramNotWhenItWasRead) {
  auto source = open();
  auto sender = sender_to(source);
  Numbered numbered(1);
  // The kernel begins to stamp a while after the first socket asks for it, and stamps what came
  // before when it is read.
  const std::int64_t deadline_ns = measure::monotonic_ns() + kPatience_ns;
  bool stamped_before_reading = false;
  while (!stamped_before_reading && measure::monotonic_ns() < deadline_ns) {
    sender.send(numbered.datagrams());
    const std::int64_t sent_by_ns = utc_ns();
    const auto received = receive(source, 1);
    ASSERT_EQ(received.size(), 1U);
    stamped_before_reading = received[0].datagram.stamp_ns <= sent_by_ns;
  }
  EXPECT_TRUE(stamped_before_reading);
}

TEST_F(UdpSourceTest, ReturnsAtMostABatchAtATime) {
  auto source = open({.batch = 4});
  auto sender = sender_to(source);
  Numbered numbered(10);
  sender.send(numbered.datagrams());
  std::vector<std::uint64_t> numbers;
  while (numbers.size() < 10) {
    const auto batch = source.receive(kPatience_ns);
    ASSERT_FALSE(batch.empty());
    EXPECT_LE(batch.size(), 4U);
    for (const auto& each : batch) numbers.push_back(number_of(each));
  }
  std::vector<std::uint64_t> expected(10);
  std::iota(expected.begin(), expected.end(), 0U);
  EXPECT_EQ(numbers, expected);
}

TEST_F(UdpSourceTest, CountsDatagramsThatTheKernelDidNotStampAndTakesTheTimeOfReading) {
  const bool is_filtered = without_socket_option(SO_TIMESTAMPNS, 0, [&] {
    auto source = open();
    auto sender = sender_to(source);
    Numbered numbered(3);
    const std::int64_t before_ns = utc_ns();
    sender.send(numbered.datagrams());
    const auto received = receive(source, 3);
    ASSERT_EQ(received.size(), 3U);
    EXPECT_GE(received.front().datagram.stamp_ns, before_ns - 60'000 * kMillisecond_ns);
    EXPECT_EQ(source.counters().unstamped, 3U);
  });
  if (!is_filtered) GTEST_SKIP() << "no system call filters here";
}

TEST_F(UdpSourceTest, CountsReadsThatTheSystemRefuses) {
  auto source = open();
  auto sender = sender_to(source);
  Numbered numbered(1);
  sender.send(numbered.datagrams());
  const bool is_filtered = without_call(SYS_recvmmsg, ENOMEM, [&] {
    EXPECT_TRUE(source.receive(kMillisecond_ns).empty());
    EXPECT_GT(source.counters().receive_errors, 0U);
  });
  if (!is_filtered) GTEST_SKIP() << "no system call filters here";
  EXPECT_EQ(receive(source, 1).size(), 1U) << "it was only late";
}

TEST_F(UdpSourceTest, ReturnsEmptyWhenNothingComes) {
  auto source = open();
  EXPECT_TRUE(source.receive(0).empty());
  EXPECT_TRUE(source.receive(-1).empty());
  EXPECT_TRUE(source.receive(5 * kMillisecond_ns).empty());
  EXPECT_EQ(source.counters().received, 0U);
  EXPECT_EQ(source.counters().receive_errors, 0U) << "there being nothing is no error";
}

TEST_F(UdpSourceTest, CountsExactlyWhatTheKernelDropped) {
  auto source = open({.receive_buffer_bytes = 1});
  auto sender = sender_to(source);
  Numbered numbered(300);
  ASSERT_EQ(sender.send(numbered.datagrams()), 300U);
  std::vector<Received> received;
  const auto accounted_for = [&](std::uint64_t sent) {
    return receive_until(source, received, [&] {
      source.refresh_drops();
      return source.counters().received + source.counters().kernel_drops == sent;
    });
  };
  EXPECT_TRUE(accounted_for(300));
  EXPECT_GT(source.counters().kernel_drops, 200U);
  EXPECT_EQ(source.counters().delivered, received.size());

  // The next datagram carries the same count, which must not be added again.
  const std::uint64_t drops = source.counters().kernel_drops;
  Numbered one_more(1, 100);
  sender.send(one_more.datagrams());
  EXPECT_TRUE(accounted_for(301));
  EXPECT_EQ(source.counters().kernel_drops, drops);
}

TEST_F(UdpSourceTest, KnowsOfDropsWhileTheBufferIsNeverEmpty) {
  auto source = open({.receive_buffer_bytes = 1, .batch = 1});
  auto sender = sender_to(source);
  Numbered numbered(300);
  ASSERT_EQ(sender.send(numbered.datagrams()), 300U);
  // The datagram is older than the drops, and says that there were none.
  ASSERT_EQ(source.receive(kPatience_ns).size(), 1U);
  EXPECT_GT(source.counters().kernel_drops, 200U);
}

TEST_F(UdpSourceTest, AcceptsOnlyTheConfiguredSenderAndCountsTheOthers) {
  auto source = open({.sender = net::Sender{kLocalhost}});
  auto sensor = sender_to(source, kLocalhost);
  auto stranger = sender_to(source, kOtherLocalhost);
  Numbered strange(30, 1206, 1000), wanted(10);
  stranger.send(strange.datagrams());
  sensor.send(wanted.datagrams());
  stranger.send(strange.datagrams());
  std::vector<Received> received;
  EXPECT_TRUE(receive_until(source, received, [&] { return source.counters().received == 70; }));
  EXPECT_EQ(numbers_of(received), (std::vector<std::uint64_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(source.counters().delivered, 10U);
  EXPECT_EQ(source.counters().foreign, 60U);
}

TEST_F(UdpSourceTest, AcceptsOnlyOnePortOfASender) {
  auto source = open();
  auto sensor = sender_to(source, kLocalhost);
  auto relay = sender_to(source, kLocalhost);
  Numbered wanted(5), strange(5, 64, 100);
  sensor.send(wanted.datagrams());
  std::vector<Received> received;
  EXPECT_TRUE(receive_until(source, received, [&] { return received.size() == 5; }));
  source.accept_only({kLocalhost, received.front().datagram.source_port});
  relay.send(strange.datagrams());
  sensor.send(wanted.datagrams());
  EXPECT_TRUE(receive_until(source, received, [&] { return source.counters().received == 15; }));
  EXPECT_EQ(source.counters().delivered, 10U);
  EXPECT_EQ(source.counters().foreign, 5U);
}

TEST_F(UdpSourceTest, TellsSeveralSensorsOnOnePortApartByAddress) {
  auto source = open();
  auto left = sender_to(source, kLocalhost);
  auto right = sender_to(source, kOtherLocalhost);
  Numbered from_left(5, 64, 0), from_right(5, 64, 100);
  left.send(from_left.datagrams());
  right.send(from_right.datagrams());
  const auto received = receive(source, 10);
  for (const Received& each : received) {
    EXPECT_EQ(each.datagram.source_address, each.number() < 100 ? kLocalhost : kOtherLocalhost);
  }
}

TEST_F(UdpSourceTest, CountsDatagramsLongerThanASlotAndDeliversNoneOfThem) {
  auto source = open({.slot_bytes = 100});
  auto sender = sender_to(source);
  Numbered longer(3, 101), fitting(2, 100);
  sender.send(longer.datagrams());
  sender.send(fitting.datagrams());
  const auto received = receive(source, 2);
  for (const Received& each : received) EXPECT_EQ(each.bytes.size(), 100U);
  EXPECT_EQ(source.counters().truncated, 3U);
  EXPECT_EQ(source.counters().delivered, 2U);
}

TEST_F(UdpSourceTest, DeliversADatagramWithoutPayload) {
  auto source = open();
  auto sender = sender_to(source);
  const std::array<packet::Datagram, 1> nothing{};
  EXPECT_EQ(sender.send(nothing), 1U);
  const auto received = receive(source, 1);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_TRUE(received[0].bytes.empty());
}

TEST_F(UdpSourceTest, IsWokenFromAnotherThread) {
  auto source = open();
  std::thread waker([&] { source.wake(); });
  EXPECT_TRUE(source.receive(INT64_MAX).empty());
  waker.join();
  source.wake();
  source.wake();
  EXPECT_TRUE(source.receive(INT64_MAX).empty())
      << "a wake before the call counts, and several once";
  EXPECT_TRUE(source.receive(kMillisecond_ns).empty());
}

const UdpSource* woken_by_signal = nullptr;

TEST_F(UdpSourceTest, IsWokenByASignalHandler) {
  auto source = open();
  woken_by_signal = &source;
  struct sigaction action{}, before{};
  action.sa_handler = [](int) { woken_by_signal->wake(); };
  ASSERT_EQ(::sigaction(SIGUSR1, &action, &before), 0);
  const pthread_t receiver = ::pthread_self();
  std::thread interrupter([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ::pthread_kill(receiver, SIGUSR1);
  });
  EXPECT_TRUE(source.receive(INT64_MAX).empty());
  interrupter.join();
  ::sigaction(SIGUSR1, &before, nullptr);
}

TEST_F(UdpSourceTest, GoesOnWaitingThroughASignalThatDoesNotWakeIt) {
  auto source = open();
  auto sender = sender_to(source);
  struct sigaction action{}, before{};
  action.sa_handler = [](int) {};
  ASSERT_EQ(::sigaction(SIGUSR1, &action, &before), 0);
  const pthread_t receiver = ::pthread_self();
  std::thread interrupter([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ::pthread_kill(receiver, SIGUSR1);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    Numbered one(1);
    sender.send(one.datagrams());
  });
  EXPECT_EQ(source.receive(kPatience_ns).size(), 1U);
  interrupter.join();
  ::sigaction(SIGUSR1, &before, nullptr);
}

TEST_F(UdpSourceTest, HearsAMulticastGroupOnTheInterfaceItJoined) {
  constexpr std::uint32_t kGroup = 0xEF4D0001, kOtherGroup = 0xEF4D0002;  // 239.77.0.1, .2
  auto source = net::UdpSource::open({.multicast_group = kGroup, .interface = "lo"}, memory_);
  if (!source) GTEST_SKIP() << "no multicast here: " << source.error().message;
  // Another program's group must not be heard too.
  auto other = open({.multicast_group = kOtherGroup, .interface = "lo"});
  const auto to = [&](std::uint32_t group) {
    return UdpSender::open({.to = {group, source->local().port}, .interface = "lo"}, memory_);
  };
  auto sensor = to(kGroup), neighbour = to(kOtherGroup);
  if (!sensor || !neighbour) GTEST_SKIP() << "no multicast here: " << sensor.error().message;
  Numbered wanted(3), unwanted(3, 64, 100);
  neighbour->send(unwanted.datagrams());
  if (sensor->send(wanted.datagrams()) == 0) {
    GTEST_SKIP() << "no multicast here: " << std::strerror(sensor->counters().last_error);
  }
  const auto received = receive(*source, 3);
  EXPECT_EQ(numbers_of(received), (std::vector<std::uint64_t>{0, 1, 2}));
  for (const Received& each : received) EXPECT_EQ(each.datagram.destination_address, kGroup);
  EXPECT_TRUE(source->receive(kMillisecond_ns).empty());
}

TEST_F(UdpSourceTest, SharesItsPortOnlyWithThoseThatShareItToo) {
  constexpr std::uint32_t kGroup = 0xEF4D0003;
  UdpSourceConfig config{.multicast_group = kGroup, .interface = "lo", .share_port = true};
  auto first = UdpSource::open(config, memory_);
  if (!first) GTEST_SKIP() << "no multicast here: " << first.error().message;
  config.bind = first->local();
  auto second = open(config);
  config.share_port = false;
  EXPECT_FALSE(UdpSource::open(config, memory_));

  auto sensor = make_sender({.to = {kGroup, first->local().port}, .interface = "lo"});
  Numbered numbered(3);
  if (sensor.send(numbered.datagrams()) == 0) {
    GTEST_SKIP() << "no multicast here: " << std::strerror(sensor.counters().last_error);
  }
  EXPECT_EQ(receive(*first, 3).size(), 3U);
  EXPECT_EQ(receive(second, 3).size(), 3U);
}

TEST_F(UdpSourceTest, TakesItsMemoryFromTheLedgerAtStart) {
  auto source = open({.batch = 32, .slot_bytes = 2048});
  EXPECT_GE(memory_.total_bytes(), 32U * 2048U);
  const std::size_t planned = memory_.total_bytes();
  auto sender = sender_to(source);
  const std::size_t with_sender = memory_.total_bytes();
  EXPECT_GT(with_sender, planned);
  Numbered numbered(50);
  sender.send(numbered.datagrams());
  EXPECT_EQ(receive(source, 50).size(), 50U);
  EXPECT_EQ(memory_.total_bytes(), with_sender);
}

}  // namespace
}  // namespace terracut::test
