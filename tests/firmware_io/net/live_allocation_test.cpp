// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/live_pcap_source.hpp"
#include "firmware_io/net/packet_ring.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tools/lab/send/packet_pacer.hpp"
#include "wire.hpp"

namespace terracut::test {
namespace {

class LiveMemory : public LiveTest {};

TEST_F(LiveMemory, ReceivingAndSendingAllocateNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  auto source = open({.interface = "lo", .sender = net::Sender{kLocalhost}});
  auto sender = sender_to(source);
  auto stranger = sender_to(source, kOtherLocalhost);
  send::PacketPacer pacer(1, memory_);
  Numbered numbered(60);
  const std::size_t planned = memory_.total_bytes();

  const std::uint64_t before = allocations_of_this_thread();
  for (const auto& each : numbered.datagrams()) pacer.add(each, sender);
  pacer.flush();
  stranger.send(numbered.datagrams());
  const std::int64_t deadline_ns = measure::monotonic_ns() + kPatience_ns;
  while (source.counters().received < 120 && measure::monotonic_ns() < deadline_ns) {
    static_cast<void>(source.receive(20 * kMillisecond_ns));
  }
  static_cast<void>(source.receive(600 * kMillisecond_ns));  // long enough to look at the interface
  source.wake();
  static_cast<void>(source.receive(kPatience_ns));
  EXPECT_EQ(allocations_of_this_thread() - before, 0U);
  EXPECT_EQ(memory_.total_bytes(), planned);
  EXPECT_EQ(source.counters().delivered, 60U);
  EXPECT_EQ(source.counters().foreign, 60U);
}

TEST_F(LiveMemory, ListeningWithLibpcapAllocatesNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  auto socket = open();
  auto source =
      net::LivePcapSource::open({.interface = "lo", .port = socket.local().port}, memory_);
  if (!source) GTEST_SKIP() << source.error().message;
  auto sender = sender_to(socket);
  Numbered numbered(60);

  const std::uint64_t before = allocations_of_this_thread();
  sender.send(numbered.datagrams());
  const std::int64_t deadline_ns = measure::monotonic_ns() + kPatience_ns;
  while (source->counters().received < 60 && measure::monotonic_ns() < deadline_ns) {
    static_cast<void>(source->receive(20 * kMillisecond_ns));
  }
  static_cast<void>(source->receive(600 * kMillisecond_ns));
  EXPECT_EQ(allocations_of_this_thread() - before, 0U);
  EXPECT_EQ(source->counters().delivered, 60U);
}

TEST_F(LiveMemory, RecordingAndCopyingWhatWasRecordedAllocateNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  const net::PacketRingSize size{20, 20 * 1208};
  net::PacketRing ring(size, memory_);
  net::PacketWindow window(size, memory_);
  Numbered numbered(50);
  const std::size_t planned = memory_.total_bytes();

  const std::uint64_t before = allocations_of_this_thread();
  for (const auto& each : numbered.datagrams()) ring.add(each);
  ring.copy_to(window);
  EXPECT_EQ(allocations_of_this_thread() - before, 0U);
  EXPECT_EQ(memory_.total_bytes(), planned);
  EXPECT_EQ(window.datagrams(), 20U);
}

}  // namespace
}  // namespace terracut::test
