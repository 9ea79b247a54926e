// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What the flight recorder costs: a datagram added by the receive thread, and the copy a dump
// begins with. Reports, asserts nothing.
#include <benchmark/benchmark.h>

#include <vector>

#include "firmware_io/net/packet_ring.hpp"

namespace terracut {
namespace {

/// Five seconds of an RS-Ruby128 in dual return, the busiest sensor handled.
net::PacketRingSize five_seconds() {
  return net::packet_ring_size(5, 12'000, 1248);
}

void add_datagram(benchmark::State& state) {
  memory::FixedMemory memory;
  net::PacketRing ring(five_seconds(), memory);
  const std::vector<std::uint8_t> payload(static_cast<std::size_t>(state.range(0)), 0x5A);
  for (auto each : state) ring.add({.payload = payload});
}
BENCHMARK(add_datagram)->Arg(1206)->Arg(1248);

void copy_ring(benchmark::State& state) {
  memory::FixedMemory memory;
  const net::PacketRingSize size = five_seconds();
  net::PacketRing ring(size, memory);
  net::PacketWindow window(size, memory);
  const std::vector<std::uint8_t> payload(1248, 0x5A);
  for (std::size_t n = 0; n < size.datagrams; ++n) ring.add({.payload = payload});
  for (auto each : state) ring.copy_to(window);
  state.SetBytesProcessed(static_cast<std::int64_t>(window.payload_bytes()) *
                          static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(copy_ring)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace terracut
